#include "ceres_ed/report/html/about.h"

#include <ceres_ed/report/html/assets.h>
#include <ceres_ed/report/html/escape.h>
#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/version.h>

#include <string>

namespace ceres_ed {

void AddAbout(const nlohmann::ordered_json& report, HtmlPage* page) {
  page->Section("About this page");
  const std::string program = TextOf(report, {"program"});
  page->Paragraph(
      "Written by ceres_ed " + std::string(kVersion) +
      (program.empty() ? "" : " from a run of " + program + " " + TextOf(report, {"version"})) +
      ". The page has all that it shows in itself; nothing is fetched when it is opened.");
  const nlohmann::ordered_json& backend = MemberOf(report, {"backend"});
  if (backend.is_object()) {
    HtmlTable table = {"Libraries of the run", {"part", "library"}, {}, 2};
    for (const auto& [name, value] : backend.items())
      table.rows.push_back({name, ValueText(value)});
    page->FoldedTable("Libraries of the run", table);
  }
  if (ThreeJs().empty()) return;
  page->Html("<details><summary>Licence of three.js</summary><pre>" + EscapeHtml(ThreeLicense()) +
             "</pre></details>\n");
}

}  // namespace ceres_ed
