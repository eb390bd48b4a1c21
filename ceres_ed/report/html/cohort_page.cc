#include "ceres_ed/report/html/cohort_page.h"

#include <ceres_ed/report/html/assets.h>
#include <ceres_ed/report/html/escape.h>
#include <ceres_ed/report/html/page.h>
#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/html/svg_plot.h>
#include <ceres_ed/report/view/number_text.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <set>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

// A column of the table of members.
struct MemberColumn {
  const char* head;
  bool is_number;
  // What is shown, and by what the table is sorted.
  std::function<std::string(const CohortPageRow&)> html;
  std::function<std::string(const CohortPageRow&)> key;
};

std::string KeyOfNumber(double value) {
  return std::isfinite(value) ? ordered_json(value).dump() : "";
}

MemberColumn Words(const char* head, std::string CohortPageRow::*text) {
  return {head,
          false,
          [text](const CohortPageRow& row) { return EscapeHtml(row.*text); },
          [text](const CohortPageRow& row) { return row.*text; }};
}

// `factor` is 100 for percentages.
MemberColumn Number(const char* head, double CohortPageRow::*value, double factor) {
  return {head,
          true,
          [value, factor](const CohortPageRow& row) {
            const double number = row.*value;
            return std::isfinite(number) ? EscapeHtml(ShortNumber(factor * number, 3)) : "-";
          },
          [value](const CohortPageRow& row) { return KeyOfNumber(row.*value); }};
}

// Returns a path as the address of a link: what has a meaning in addresses is escaped.
std::string Address(const std::string& path) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  // A path whose first part has a colon would be an address of another kind.
  std::string address = path.empty() || path[0] == '/' ? "" : "./";
  for (const char c : path) {
    if (kPlain.find(c) != std::string_view::npos) {
      address += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    address += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
  }
  return address;
}

std::string Linked(const std::string& report, const std::string& html) {
  return report.empty() ? html : "<a href=\"" + Address(report) + "\">" + html + "</a>";
}

std::vector<MemberColumn> Columns() {
  using R = CohortPageRow;
  return {{"picture",
           false,
           [](const R& row) {
             if (row.thumbnail.empty()) return std::string();
             return Linked(row.report,
                           "<img loading=\"lazy\" width=\"160\" alt=\"" + EscapeHtml(row.name) +
                               "\" src=\"" + Address(row.thumbnail) + "\">");
           },
           [](const R& row) { return row.thumbnail; }},
          {"name",
           false,
           [](const R& row) { return Linked(row.report, EscapeHtml(row.name)); },
           [](const R& row) { return row.name; }},
          Words("group", &R::group),
          Words("verdict", &R::verdict),
          Number("unmatched [%]", &R::unmatched, 100.0),
          Number("landmarks, rms", &R::landmark_rms, 1.0),
          Number("stretch [%]", &R::stretch, 100.0),
          Number("seconds", &R::seconds, 1.0),
          {"in the mean",
           false,
           [](const R& row) { return std::string(row.in_model ? "yes" : "no"); },
           [](const R& row) { return std::string(row.in_model ? "yes" : "no"); }},
          Words("message", &R::message)};
}

constexpr int kGroupColumn = 2;
constexpr int kVerdictColumn = 3;

// Returns a choice of the values of a column.
std::string Choice(const std::string& label, int column, const std::set<std::string>& values) {
  std::string html = "<label>" + EscapeHtml(label) + " <select data-column=\"" +
                     std::to_string(column) + "\"><option value=\"*\">all</option>";
  for (const std::string& value : values) {
    html += "<option value=\"" + EscapeHtml(value) + "\">" +
            EscapeHtml(value.empty() ? "(none)" : value) + "</option>";
  }
  return html + "</select></label>\n";
}

void AddMembers(const CohortPageContent& content, HtmlPage* page) {
  std::set<std::string> groups;
  std::set<std::string> verdicts;
  for (const CohortPageRow& row : content.rows) {
    groups.insert(row.group);
    verdicts.insert(row.verdict);
  }
  page->Html("<div class=\"controls\">\n" + Choice("Group", kGroupColumn, groups) +
             Choice("Verdict", kVerdictColumn, verdicts) +
             "<output id=\"shown\"></output></div>\n");
  std::string html =
      "<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"All members\"><table "
      "id=\"members\"><caption>All members, the worst first. A head sorts the table.</caption>"
      "<thead><tr>";
  const std::vector<MemberColumn> columns = Columns();
  for (const MemberColumn& column : columns) {
    html += std::string("<th scope=\"col\"") + (column.is_number ? " class=\"n\"" : "") +
            "><button type=\"button\">" + EscapeHtml(column.head) + "</button></th>";
  }
  html += "</tr></thead><tbody>\n";
  for (const CohortPageRow& row : content.rows) {
    html += "<tr>";
    for (const MemberColumn& column : columns) {
      html += std::string("<td") + (column.is_number ? " class=\"n\"" : "") + " data-key=\"" +
              EscapeHtml(column.key(row)) + "\">" + column.html(row) + "</td>";
    }
    html += "</tr>\n";
  }
  page->Html(html + "</tbody></table></div>\n");
}

// Returns the numbers of a list with their places 1, 2, ...
PlotSeries SeriesOf(const std::string& name, const ordered_json& list, double factor) {
  PlotSeries series;
  series.name = name;
  if (!list.is_array()) return series;
  for (const ordered_json& value : list) {
    if (!value.is_number()) continue;
    series.x.push_back(static_cast<double>(series.x.size() + 1));
    series.y.push_back(factor * value.get<double>());
  }
  return series;
}

void AddModel(const ordered_json& statistics, HtmlPage* page) {
  page->Section("Shape model");
  page->List(
      {ValueText(MemberOf(statistics, {"shapes"})) + " shapes take part, with verdicts up to " +
           TextOf(statistics, {"worst"}) + "; " + ValueText(MemberOf(statistics, {"vertices"})) +
           " vertices each.",
       "Alignment: " + TextOf(statistics, {"align"}) + ".",
       "Total variance: " + ValueText(MemberOf(statistics, {"components", "total_variance"})) +
           " (squared unit, sum of all vertices).",
       "The mean is " + ShortNumber(100.0 * NumberOf(statistics, {"change"}), 3) +
           " % of the diagonal away from the template."});
  page->Html("<div class=\"plots\">\n");
  page->Plot(
      LinePlot({"component", "explained variance [%]", "Explained variance of each component"},
               {SeriesOf("explained", MemberOf(statistics, {"components", "explained"}), 100.0)}),
      "The share of the variance that each component explains.");
  page->Plot(
      LinePlot(
          {"components", "distance [file units]", "Generalisation and specificity"},
          {SeriesOf("generalisation", MemberOf(statistics, {"quality", "generalization"}), 1.0),
           SeriesOf("specificity", MemberOf(statistics, {"quality", "specificity"}), 1.0)}),
      "Generalisation: how far a shape is from the model of all others. Specificity: how far a "
      "random shape of the model is from the nearest real one. Less is better.");
  page->Html("</div>\n");
}

void AddGroups(const ordered_json& statistics, HtmlPage* page) {
  const ordered_json& groups = MemberOf(statistics, {"groups"});
  if (!groups.is_object()) return;
  page->Section("Groups");
  HtmlTable table = {"Shapes of each group", {"group", "shapes"}, {}, 1};
  const ordered_json& shapes = MemberOf(groups, {"shapes"});
  for (const auto& [name, count] : shapes.items()) table.rows.push_back({name, ValueText(count)});
  page->Table(table);
  page->List({"Permutations: " + ValueText(MemberOf(groups, {"permutations"})) + ".",
              "Vertices with p <= 0.05: " + ValueText(MemberOf(groups, {"vertices_below_0.05"})) +
                  "; corrected for the number of vertices: " +
                  ValueText(MemberOf(groups, {"vertices_below_0.05_corrected"})) + ".",
              "Least corrected p: " + ValueText(MemberOf(groups, {"least_p_corrected"})) + ".",
              "Largest difference of two means: " +
                  ValueText(MemberOf(groups, {"largest_difference"})) + " (file units)."});
}

void AddRounds(const ordered_json& statistics, HtmlPage* page) {
  const ordered_json& rounds = MemberOf(statistics, {"rounds"});
  if (!rounds.is_array() || rounds.empty()) return;
  page->Section("Rounds of the template");
  HtmlTable table = {
      "How far the mean of each round is from its template", {"round", "change [%]"}, {}, 0};
  for (const ordered_json& round : rounds) {
    table.rows.push_back({ValueText(MemberOf(round, {"round"})),
                          ShortNumber(100.0 * NumberOf(round, {"change"}), 3)});
  }
  page->Table(table);
}

}  // namespace

std::string CohortPage(const CohortPageContent& content) {
  std::map<std::string, int> counts;
  for (const CohortPageRow& row : content.rows) ++counts[row.verdict];
  HtmlPage page(std::to_string(content.rows.size()) + " " + content.kind);
  page.AllowFilesBeside();
  std::string numbers;
  for (const char* const verdict : {"good", "doubtful", "bad", "failed", "missing"}) {
    if (counts[verdict] == 0) continue;
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(counts[verdict]) + " " + verdict;
  }
  page.Paragraph(numbers + (content.source.empty() ? "." : ". Template: " + content.source + "."));
  if (content.statistics.is_object()) {
    AddModel(content.statistics, &page);
    AddGroups(content.statistics, &page);
    AddRounds(content.statistics, &page);
  }
  page.Section("Members");
  AddMembers(content, &page);
  page.Html("<script>\n" + std::string(CohortJs()) + "\n</script>\n");
  return page.Finish();
}

}  // namespace ceres_ed
