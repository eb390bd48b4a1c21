#include "ceres_ed/report/html/compared_reports.h"

#include <ceres_ed/report/html/report_json.h>

namespace ceres_ed {

using nlohmann::ordered_json;

void AddFlagsThatDiffer(const std::vector<std::pair<std::string, const ordered_json*>>& reports,
                        HtmlPage* page) {
  page->Section("Flags that differ");
  HtmlTable table = {"Flags that differ", {"flag"}, {}, static_cast<int>(reports.size()) + 1};
  std::vector<std::string> names;
  ordered_json known = ordered_json::object();
  for (const auto& [run, report] : reports) {
    table.head.push_back(run);
    const ordered_json& flags = MemberOf(*report, {"flags"});
    if (!flags.is_object()) continue;
    for (const auto& [name, value] : flags.items()) {
      if (!known.contains(name)) names.push_back(name);
      known[name] = true;
    }
  }
  for (const std::string& name : names) {
    std::vector<std::string> row = {"--" + name};
    bool is_equal = true;
    for (const auto& [run, report] : reports) {
      row.push_back(FlagText(MemberOf(*report, {"flags", name.c_str()})));
      is_equal = is_equal && row.back() == row[1];
    }
    if (!is_equal) table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) page->Paragraph("All flags are equal.");
  page->Table(table);
}

}  // namespace ceres_ed
