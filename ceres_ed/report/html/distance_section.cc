#include "ceres_ed/report/html/distance_section.h"

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/report/html/svg_plot.h>
#include <ceres_ed/report/view/number_text.h>

#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

struct NamedDistances {
  std::string name;
  const std::vector<double>* distances;
};

HtmlTable FiguresOf(const std::vector<NamedDistances>& all, double diagonal) {
  HtmlTable table = {"Figures of all distances, in file units",
                     {"distance", "mean", "rms", "median", "95 %", "99 %", "largest"},
                     {},
                     1};
  const bool has_percent = diagonal > 0.0;
  if (has_percent) table.head.emplace_back("mean in % of the target's diagonal");
  for (const NamedDistances& one : all) {
    if (one.distances->empty()) continue;
    const DistanceStatistics s = Summarize(*one.distances);
    std::vector<std::string> row = {one.name};
    for (const double figure : {s.mean, s.rms, s.p50, s.p95, s.p99, s.max}) {
      row.push_back(ShortNumber(figure));
    }
    if (has_percent) row.push_back(ShortNumber(s.InPercentOf(diagonal).mean));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

void AddDistances(const FitDistances& distances, double diagonal, HtmlPage* page) {
  const bool has_target = !distances.to_target.empty();
  const bool has_truth = !distances.to_truth.empty();
  if (!has_target && !has_truth) return;
  page->Section("Distances");
  const std::vector<NamedDistances> all = {
      {"result to target", &distances.to_target},
      {"rigid placement to target", &distances.rigid_to_target},
      {"target to result", &distances.from_target},
      {"result to its true place", &distances.to_truth},
      {"rigid placement to its true place", &distances.rigid_to_truth}};
  page->Table(FiguresOf(all, diagonal));
  page->Html("<div class=\"plots\">\n");
  for (const auto& [name, values] :
       {std::pair("distance to target", &distances.to_target),
        std::pair("distance to the true place", &distances.to_truth)}) {
    if (values->empty()) continue;
    const HistogramBins bins = CountBins(*values);
    page->Plot(HistogramPlot({std::string(name) + " [file units]",
                              "points",
                              std::string("Histogram of the ") + name +
                                  "; the table of distances has its figures"},
                             bins),
               std::string("Histogram of the ") + name + " of all points of the result; " +
                   std::to_string(bins.beyond) + " of them are farther.");
  }
  std::vector<PlotSeries> curves;
  for (const NamedDistances& one : all) {
    if (!one.distances->empty()) curves.push_back(CumulativeSeries(one.name, *one.distances));
  }
  page->Plot(
      LinePlot({"distance [file units]",
                "share of points [%]",
                "Cumulative curves of all distances; the table of distances has the figures"},
               curves,
               {/*log_x=*/true, /*log_y=*/false}),
      "The share of points that are nearer than a distance (logarithmic): rigid placement "
      "against fit.");
  page->Html("</div>\n");
}

}  // namespace ceres_ed
