#include <ceres_ed/report/html/svg_plot.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const PlotLabels kLabels = {"x <mm>", "y", "a \"plot\""};

TEST(LinePlot, LabelsAreEscaped) {
  const std::string svg =
      LinePlot(kLabels, {{"one & two", {0.0, 1.0}, {0.0, 1.0}}, {"<i>", {0.0, 1.0}, {1.0, 0.0}}});
  EXPECT_THAT(svg, HasSubstr("x &lt;mm&gt;"));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"a &quot;plot&quot;\""));
  EXPECT_THAT(svg, HasSubstr("one &amp; two"));
  EXPECT_THAT(svg, Not(HasSubstr("<i>")));
}

TEST(LinePlot, TheEndsOfTheRangeAreTheCornersOfTheAxes) {
  const std::string svg = LinePlot(kLabels, {{"", {0.0, 1.0}, {0.0, 4.0}}});
  EXPECT_THAT(svg, HasSubstr("points=\"72.00,252.00 544.00,14.00 \""));
}

TEST(LinePlot, ALogarithmicAxisLeavesOutWhatHasNoLogarithm) {
  const std::string svg = LinePlot(kLabels,
                                   {{"", {1.0, 2.0, 3.0, 4.0}, {1.0, 0.0, std::nan(""), 100.0}}},
                                   {/*log_x=*/false, /*log_y=*/true});
  EXPECT_THAT(svg, HasSubstr("points=\"72.00,252.00 544.00,14.00 \""));
}

TEST(LinePlot, NothingToDrawIsNoPlot) {
  EXPECT_EQ(LinePlot(kLabels, {}), "");
  EXPECT_EQ(LinePlot(kLabels, {{"", {std::nan("")}, {1.0}}}), "");
}

TEST(LinePlot, OneValueIsAPlot) { EXPECT_NE(LinePlot(kLabels, {{"", {1.0}, {3.0}}}), ""); }

TEST(Histogram, CountsEveryValueOnce) {
  std::vector<double> values(1001);
  std::iota(values.begin(), values.end(), 0.0);
  values.push_back(std::nan(""));
  const HistogramBins bins = CountBins(values, 10);
  EXPECT_EQ(bins.high, 990.0);
  EXPECT_EQ(bins.beyond, 10);
  EXPECT_EQ(std::accumulate(bins.counts.begin(), bins.counts.end(), 0), 991);
  for (const int count : bins.counts) EXPECT_NEAR(count, 99, 1);
}

TEST(Histogram, EqualValuesHaveABin) {
  const HistogramBins bins = CountBins(std::vector<double>(20, 0.0), 5);
  EXPECT_EQ(bins.counts[0], 20);
  EXPECT_NE(HistogramPlot(kLabels, bins), "");
  EXPECT_EQ(HistogramPlot(kLabels, CountBins({}, 5)), "");
}

TEST(CumulativeSeries, HalfOfTheValuesAreBelowTheMedian) {
  std::vector<double> values(1001);
  std::iota(values.begin(), values.end(), 0.0);
  const PlotSeries series = CumulativeSeries("", values);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    EXPECT_NEAR(series.x[i], 10.0 * series.y[i], 1.0);
  }
}

TEST(BarPlot, TheLongestBarFillsTheWidth) {
  const std::string svg = BarPlot(kLabels, {{"a", 1.0, "1 s"}, {"b", 4.0, "4 s"}});
  EXPECT_THAT(svg, HasSubstr("width=\"80.00\""));
  EXPECT_THAT(svg, HasSubstr("width=\"320.00\""));
  EXPECT_EQ(BarPlot(kLabels, {{"a", 0.0, ""}}), "");
}

}  // namespace
}  // namespace ceres_ed
