#include "ceres_ed/report/html/comparison_page.h"

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/report/html/about.h>
#include <ceres_ed/report/html/compared_reports.h>
#include <ceres_ed/report/html/page.h>
#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/html/svg_plot.h>
#include <ceres_ed/report/html/viewer.h>
#include <ceres_ed/report/view/comparison_view.h>
#include <ceres_ed/report/view/number_text.h>

#include <cstddef>
#include <functional>
#include <utility>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

// One row of the figures.
struct ComparedFigure {
  const char* name;
  std::function<std::string(const ComparedRun&)> text;
};

std::string MeanOf(const std::vector<double>& distances) {
  return distances.empty() ? "-" : ShortNumber(Summarize(distances).mean, 4);
}

std::vector<ComparedFigure> Figures() {
  const auto member = [](ReportPath path) {
    const std::vector<const char*> names(path);
    return [names](const ComparedRun& run) {
      const ordered_json* at = &run.report;
      for (const char* const name : names) at = &MemberOf(*at, {name});
      return ValueText(*at, 4);
    };
  };
  return {{"verdict", member({"verdict", "grade"})},
          {"status", member({"status"})},
          {"source", member({"source", "path"})},
          {"target", member({"target", "path"})},
          {"mean distance, result to target",
           [](const ComparedRun& run) { return MeanOf(run.view.distances.to_target); }},
          {"mean distance, target to result",
           [](const ComparedRun& run) { return MeanOf(run.view.distances.from_target); }},
          {"mean distance to the true place",
           [](const ComparedRun& run) { return MeanOf(run.view.distances.to_truth); }},
          {"rms point to plane", member({"rms", "point_to_plane"})},
          {"unmatched share of the source", member({"unmatched", "source"})},
          {"unmatched share of the target", member({"unmatched", "target"})},
          {"landmarks, rms", member({"landmarks", "rms"})},
          {"energy at the end", member({"energy", "final"})},
          {"nodes", member({"nodes", "total"})},
          {"PR nodes", member({"nodes", "pr"})},
          {"rounds", member({"outer_iterations"})},
          {"seconds", member({"time_s", "total"})},
          {"threads", member({"threads"})},
          {"version", member({"version"})}};
}

HtmlTable HeadOf(const std::string& caption,
                 const char* first,
                 const std::vector<ComparedRun>& runs) {
  HtmlTable table = {caption, {first}, {}, static_cast<int>(runs.size()) + 1};
  for (const ComparedRun& run : runs) table.head.push_back(run.name);
  return table;
}

void AddCurves(const std::vector<ComparedRun>& runs, HtmlPage* page) {
  std::vector<PlotSeries> target;
  std::vector<PlotSeries> truth;
  for (const ComparedRun& run : runs) {
    const FitDistances& distances = run.view.distances;
    if (!distances.to_target.empty()) {
      target.push_back(CumulativeSeries(run.name, distances.to_target));
    }
    if (!distances.to_truth.empty())
      truth.push_back(CumulativeSeries(run.name, distances.to_truth));
  }
  page->Html("<div class=\"plots\">\n");
  const PlotScales scales = {/*log_x=*/true, /*log_y=*/false};
  page->Plot(LinePlot({"distance to target [file units]",
                       "share of points [%]",
                       "Cumulative curves of the distance to the target of each run"},
                      target,
                      scales),
             "The share of points that are nearer to the target than a distance.");
  page->Plot(LinePlot({"distance to the true place [file units]",
                       "share of points [%]",
                       "Cumulative curves of the distance to the true place of each run"},
                      truth,
                      scales),
             "The share of points that are nearer to their true place than a distance.");
  page->Html("</div>\n");
}

}  // namespace

Scene SceneOfRuns(const std::vector<ComparedRun>& runs) {
  std::vector<const Scene*> scenes;
  std::vector<std::string> names;
  for (const ComparedRun& run : runs) {
    scenes.push_back(&run.view.scene);
    names.push_back(run.name);
  }
  Scene scene = CompareScenes(scenes, names);
  for (const ComparedRun& run : runs) {
    for (const std::string& note : run.view.scene.notes)
      scene.notes.push_back(run.name + ": " + note);
  }
  return scene;
}

std::string ComparisonPage(const std::vector<ComparedRun>& runs,
                           const Scene& scene,
                           const std::string& picture_png) {
  HtmlPage page(std::to_string(runs.size()) + " runs compared");
  page.Section("Figures");
  HtmlTable table = HeadOf("Figures of all runs", "figure", runs);
  for (const ComparedFigure& figure : Figures()) {
    std::vector<std::string> row = {figure.name};
    bool is_known = false;
    for (const ComparedRun& run : runs) {
      row.push_back(figure.text(run));
      is_known = is_known || row.back() != "-";
    }
    if (is_known) table.rows.push_back(std::move(row));
  }
  page.Table(table);
  std::vector<std::pair<std::string, const ordered_json*>> reports;
  reports.reserve(runs.size());
  for (const ComparedRun& run : runs) reports.emplace_back(run.name, &run.report);
  AddFlagsThatDiffer(reports, &page);
  page.Section("View");
  AddViewer(scene, picture_png, &page);
  AddCurves(runs, &page);
  AddAbout({}, &page);
  return page.Finish();
}

}  // namespace ceres_ed
