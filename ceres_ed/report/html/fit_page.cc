#include "ceres_ed/report/html/fit_page.h"

#include <ceres_ed/report/html/about.h>
#include <ceres_ed/report/html/distance_section.h>
#include <ceres_ed/report/html/evidence_words.h>
#include <ceres_ed/report/html/page.h>
#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/html/run_sections.h>
#include <ceres_ed/report/html/svg_plot.h>
#include <ceres_ed/report/html/viewer.h>
#include <ceres_ed/report/view/number_text.h>

#include <map>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

void AddSummary(const ordered_json& report, HtmlPage* page) {
  std::vector<std::string> lines;
  const std::string status = TextOf(report, {"status"});
  if (!status.empty()) {
    lines.push_back("Status: " + status + " (" + TextOf(report, {"message"}) + ").");
  }
  for (const char* const name : {"source", "target"}) {
    const ordered_json& file = MemberOf(report, {name});
    if (!file.is_object()) continue;
    const std::string role = name[0] == 's' ? "Source" : "Target";
    lines.push_back(role + ": " + TextOf(file, {"path"}) + ", " +
                    ValueText(MemberOf(file, {"points"})) + " points, " +
                    ValueText(MemberOf(file, {"faces"})) + " faces, diagonal " +
                    ShortNumber(NumberOf(file, {"diagonal"}), 4) + ".");
  }
  if (!lines.empty()) page->Subsection("Run");
  page->List(lines);
}

void AddEnergy(const ordered_json& report, HtmlPage* page) {
  const ordered_json& terms = MemberOf(report, {"energy", "terms"});
  if (!terms.is_object() || terms.empty()) return;
  page->Section("Energy");
  const ordered_json& rounds = MemberOf(report, {"energy", "rounds"});
  std::vector<PlotSeries> series;
  HtmlTable history = {"Energy of each term after each round, without unit",
                       {"round", "stiffness", "inliers"},
                       {},
                       0};
  if (rounds.is_array()) {
    std::map<std::string, std::size_t> number;
    for (std::size_t r = 0; r < rounds.size(); ++r) {
      const ordered_json& of_terms = MemberOf(rounds[r], {"terms"});
      std::vector<std::string> row = {std::to_string(r + 1),
                                      ValueText(MemberOf(rounds[r], {"stiffness"}), 3),
                                      ValueText(MemberOf(rounds[r], {"inliers"}))};
      if (!of_terms.is_object()) continue;
      for (const auto& [name, value] : of_terms.items()) {
        const auto [entry, is_new] = number.emplace(name, series.size());
        if (is_new) {
          series.push_back({name, {}, {}});
          history.head.push_back(name);
        }
        series[entry->second].x.push_back(static_cast<double>(r + 1));
        series[entry->second].y.push_back(value.is_number() ? value.get<double>() : 0.0);
        row.push_back(ValueText(value, 4));
      }
      history.rows.push_back(std::move(row));
    }
  }
  page->Plot(
      LinePlot({"round on the finest graph",
                "energy (weighted)",
                "Lines of the energy of each term over the rounds; the table has the figures"},
               series,
               {/*log_x=*/false, /*log_y=*/true}),
      "The energy of each term after each round on the finest graph, with the final weights.");
  page->FoldedTable("Figures of all rounds", history);
  HtmlTable table = {"Energy of each term at the end, without unit",
                     {"term", "weighted", "raw", "residuals"},
                     {},
                     1};
  for (const auto& [name, term] : terms.items()) {
    table.rows.push_back({name,
                          ShortNumber(NumberOf(term, {"weighted"}), 4),
                          ShortNumber(NumberOf(term, {"raw"}), 4),
                          ValueText(MemberOf(term, {"residuals"}))});
  }
  table.rows.push_back(
      {"all, at the beginning", ShortNumber(NumberOf(report, {"energy", "initial"}), 4)});
  table.rows.push_back({"all, at the end", ShortNumber(NumberOf(report, {"energy", "final"}), 4)});
  page->Table(table);
}

void AddLandmarks(const Scene& scene, HtmlPage* page) {
  if (scene.landmarks.empty()) return;
  page->Section("Landmarks");
  HtmlTable table = {
      "Distance of each landmark from its place, in file units", {"landmark", "error"}, {}, 1};
  for (const ViewLandmark& landmark : scene.landmarks) {
    table.rows.push_back({landmark.name, ShortNumber(landmark.error, 4)});
  }
  page->Table(table);
}

void AddGraph(const ordered_json& report, HtmlPage* page) {
  const ordered_json& nodes = MemberOf(report, {"nodes"});
  if (!nodes.is_object()) return;
  page->Section("Graph");
  page->Paragraph(
      "Nodes that data reach are point relevant (PR); all others are point irrelevant (PI) and "
      "follow the energies that join neighbours.");
  HtmlTable table = {"Numbers of nodes and edges", {"nodes", "PR", "PI", "edges"}, {}, 0};
  table.rows.push_back({ValueText(MemberOf(nodes, {"total"})),
                        ValueText(MemberOf(nodes, {"pr"})),
                        ValueText(MemberOf(nodes, {"pi"})),
                        ValueText(MemberOf(nodes, {"edges"}))});
  page->Table(table);
  const ordered_json& covariance = MemberOf(report, {"covariance"});
  if (!covariance.is_object()) return;
  page->Paragraph("Uncertainty: the mean standard deviation of a point is " +
                  ShortNumber(NumberOf(covariance, {"mean"}), 3) + ", the largest " +
                  ShortNumber(NumberOf(covariance, {"max"}), 3) + " file units; " +
                  ValueText(MemberOf(covariance, {"undetermined_points"})) +
                  " points are undetermined.");
}

// Returns the last `parts` parts of a path.
std::string EndOfPath(const std::string& path, int parts) {
  std::size_t slash = path.size();
  for (int i = 0; i < parts; ++i) {
    if (slash == 0) return path;
    slash = path.find_last_of('/', slash - 1);
    if (slash == std::string::npos) return path;
  }
  return path.substr(slash + 1);
}

}  // namespace

std::string FitTitle(const ordered_json& report) {
  const std::string source = TextOf(report, {"source", "path"});
  const std::string target = TextOf(report, {"target", "path"});
  const std::string result = TextOf(report, {"result", "path"});
  // Pairs are often folders, each with a source and a target.
  const std::string from = EndOfPath(source.empty() ? result : source, 2);
  if (from.empty()) return "Fit";
  return target.empty() ? from : from + " \xE2\x86\x92 " + EndOfPath(target, 1);
}

std::string FitPage(const ordered_json& report,
                    const FitView& view,
                    const std::string& picture_png) {
  HtmlPage page(FitTitle(report));
  AddVerdict(report, &page);
  page.List(EvidenceSentences(report));
  AddSummary(report, &page);
  page.Section("View");
  AddViewer(view.scene, picture_png, &page);
  AddDistances(view.distances, NumberOf(report, {"target", "diagonal"}), &page);
  AddLandmarks(view.scene, &page);
  AddEnergy(report, &page);
  AddTimes(report, &page);
  AddGraph(report, &page);
  AddChecks(report, &page);
  AddFlags(report, &page);
  AddAbout(report, &page);
  return page.Finish();
}

}  // namespace ceres_ed
