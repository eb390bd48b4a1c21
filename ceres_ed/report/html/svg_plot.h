// Plots as SVG, with axes, labels and a text for those who do not see them. Colours and fonts are
// those of the page's style sheet.
#ifndef CERES_ED_REPORT_HTML_SVG_PLOT_H_
#define CERES_ED_REPORT_HTML_SVG_PLOT_H_

#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// The words around a plot. They may come from outside.
struct PlotLabels {
  std::string x;
  std::string y;
  // The text in place of the plot.
  std::string description;
};

struct PlotSeries {
  std::string name;
  // Two lists of the same size; points that are not finite are left out.
  std::vector<double> x;
  std::vector<double> y;
};

// The first and the last frame of a sequence.
struct FrameRange {
  int first = 0;
  int last = 0;
};

// Which axes are logarithmic; values <= 0 are left out there.
struct PlotScales {
  bool log_x = false;
  bool log_y = false;
  // x are the frames of a sequence: the axis has all of them, and the page marks the frame that it
  // shows, and shows the frame that is clicked (assets/scripts/timeline.js).
  std::optional<FrameRange> frames = std::nullopt;
};

// Returns lines through the points of each series, with a legend above them. Series differ by
// colour and by dashes. It is empty if there is nothing to draw.
std::string LinePlot(const PlotLabels& labels,
                     const std::vector<PlotSeries>& series,
                     const PlotScales& scales = {});

// Equal bins between `low` and `high`.
struct HistogramBins {
  double low = 0.0;
  double high = 0.0;
  std::vector<int> counts;
  // The number of values beyond `high`, which no bin has.
  int beyond = 0;
};

// Counts the finite values, from 0 to their 99th percentile; values are >= 0.
HistogramBins CountBins(const std::vector<double>& values, int bins = 40);

std::string HistogramPlot(const PlotLabels& labels, const HistogramBins& bins);

// Returns the share of values (in percent) that are at most x, as a series. NaN is left out.
PlotSeries CumulativeSeries(const std::string& name, std::vector<double> values);

// Returns a strip over the frames `numbers` (ascending), with the colour and the sign of the status
// of each, and a legend. Empty without frames.
std::string StatusStrip(const std::string& description,
                        const std::vector<int>& numbers,
                        const std::vector<std::string>& statuses);

struct PlotBar {
  std::string name;
  double value = 0.0;
  // The value as text.
  std::string text;
};

// Returns horizontal bars from 0, one below the other.
std::string BarPlot(const PlotLabels& labels, const std::vector<PlotBar>& bars);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_SVG_PLOT_H_
