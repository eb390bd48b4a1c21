#include "ceres_ed/report/html/sequence_comparison_page.h"

#include <ceres_ed/report/html/about.h>
#include <ceres_ed/report/html/compared_reports.h>
#include <ceres_ed/report/html/page.h>
#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/html/timeline_section.h>
#include <ceres_ed/report/html/viewer.h>
#include <ceres_ed/report/view/comparison_view.h>
#include <ceres_ed/report/view/number_text.h>

#include <utility>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

// A figure of report.json, with the factor of its unit.
struct ReportFigure {
  const char* name;
  std::vector<const char*> path;
  double factor = 1.0;
};

const std::vector<ReportFigure>& Figures() {
  constexpr double kMilli = 1000.0;
  static const std::vector<ReportFigure> figures = {
      {"verdict", {"verdict", "grade"}},
      {"status", {"status"}},
      {"sequence", {"sequence", "path"}},
      {"mode", {"mode"}},
      {"frames", {"frames", "processed"}},
      {"tracked", {"frames", "tracked"}},
      {"relocalized", {"frames", "relocalized"}},
      {"lost", {"frames", "lost"}},
      {"skipped", {"frames", "skipped"}},
      {"residual, median [mm]", {"rms_plane", "median"}, kMilli},
      {"residual, max [mm]", {"rms_plane", "max"}, kMilli},
      {"frame, median [ms]", {"latency_ms", "p50"}},
      {"frame, 95 % [ms]", {"latency_ms", "p95"}},
      {"nodes", {"nodes", "total"}},
      {"map points", {"map", "points"}},
      {"node spacing [mm]", {"map", "node_spacing"}, kMilli},
      {"memory [MiB]", {"memory_peak_mib"}},
      {"seconds", {"time_s", "total"}},
      {"threads", {"threads"}},
      {"version", {"version"}}};
  return figures;
}

std::string TextOfFigure(const ordered_json& report, const ReportFigure& figure) {
  const ordered_json* at = &report;
  for (const char* const name : figure.path) at = &MemberOf(*at, {name});
  if (at->is_number_float()) return ShortNumber(figure.factor * at->get<double>(), 4);
  return ValueText(*at, 4);
}

HtmlTable FigureTable(const std::vector<ComparedSequence>& runs) {
  HtmlTable table = {"Figures of all runs", {"figure"}, {}, static_cast<int>(runs.size()) + 1};
  for (const ComparedSequence& run : runs) table.head.push_back(run.name);
  const auto add = [&](const std::string& name, const auto& text_of) {
    std::vector<std::string> row = {name};
    bool is_known = false;
    for (const ComparedSequence& run : runs) {
      row.push_back(text_of(run));
      is_known = is_known || row.back() != "-";
    }
    if (is_known) table.rows.push_back(std::move(row));
  };
  for (const ReportFigure& figure : Figures()) {
    add(figure.name, [&](const ComparedSequence& run) { return TextOfFigure(run.report, figure); });
  }
  add("mean distance to the true place [mm]", [](const ComparedSequence& run) -> std::string {
    if (run.view.errors.empty()) return "-";
    double sum = 0.0;
    for (const MomentError& error : run.view.errors) sum += error.mean;
    constexpr double kMilli = 1000.0;
    return ShortNumber(kMilli * sum / static_cast<double>(run.view.errors.size()), 4);
  });
  return table;
}

}  // namespace

Scene SceneOfSequences(const std::vector<ComparedSequence>& runs) {
  std::vector<const Scene*> scenes;
  std::vector<std::string> names;
  for (const ComparedSequence& run : runs) {
    scenes.push_back(&run.view.scene);
    names.push_back(run.name);
  }
  Scene scene = CompareScenes(scenes, names);
  scene.camera = runs[0].view.scene.camera;
  for (const ComparedSequence& run : runs) {
    for (const std::string& note : run.view.scene.notes) {
      scene.notes.push_back(run.name + ": " + note);
    }
  }
  return scene;
}

std::string SequenceComparisonPage(const std::vector<ComparedSequence>& runs,
                                   const Scene& scene,
                                   const std::string& picture_png) {
  HtmlPage page(std::to_string(runs.size()) + " runs compared");
  page.Section("Figures");
  page.Table(FigureTable(runs));
  std::vector<std::pair<std::string, const ordered_json*>> reports;
  std::vector<std::pair<std::string, const FrameLog*>> logs;
  for (const ComparedSequence& run : runs) {
    reports.emplace_back(run.name, &run.report);
    logs.emplace_back(run.name, &run.view.log);
  }
  AddFlagsThatDiffer(reports, &page);
  page.Section("View");
  AddViewer(scene, picture_png, &page);
  AddTimelines(logs, &page);
  AddAbout({}, &page);
  return page.Finish();
}

}  // namespace ceres_ed
