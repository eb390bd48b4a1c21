#include "ceres_ed/report/html/svg_plot.h"

#include <ceres_ed/report/html/escape.h>
#include <ceres_ed/report/view/number_text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>

namespace ceres_ed {
namespace {

// The plot in units of the SVG; the page scales it.
constexpr double kWidth = 560.0;
constexpr double kHeight = 300.0;
constexpr double kLeft = 72.0;
constexpr double kRight = 16.0;
constexpr double kTop = 14.0;
constexpr double kBottom = 48.0;
constexpr double kTickLength = 5.0;
constexpr double kLegendRow = 18.0;
constexpr int kNumStyles = 7;
constexpr char kFramesClass[] = " frames";

std::string Number(double value) {
  constexpr int kSize = 64;
  char text[kSize];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

// `data` are more attributes and classes.
std::string Open(const PlotLabels& labels,
                 double height,
                 const std::string& more_classes = "",
                 const std::string& data = "") {
  return "<svg class=\"plot" + more_classes + "\"" + data + " viewBox=\"0 0 " + Number(kWidth) +
         " " + Number(height) + "\" role=\"img\" aria-label=\"" + EscapeHtml(labels.description) +
         "\">\n";
}

// Returns where the frames of a plot are, for the scripts of the page.
std::string FrameData(const FrameRange& frames, double left, double right) {
  return " data-low=\"" + std::to_string(frames.first) + "\" data-high=\"" +
         std::to_string(frames.last) + "\" data-left=\"" + Number(left) + "\" data-right=\"" +
         Number(right) + "\"";
}

std::string Line(double x1, double y1, double x2, double y2, const char* style) {
  return "<line class=\"" + std::string(style) + "\" x1=\"" + Number(x1) + "\" y1=\"" + Number(y1) +
         "\" x2=\"" + Number(x2) + "\" y2=\"" + Number(y2) + "\"/>\n";
}

std::string Text(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + Number(x) + "\" y=\"" + Number(y) + "\" text-anchor=\"" + anchor + "\">" +
         EscapeHtml(text) + "</text>\n";
}

// An axis that takes values to places. Logarithmic axes get the logarithms.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  double first = 0.0;
  double last = 1.0;
  bool is_log = false;

  double At(double value) const {
    const double v = is_log ? std::log10(value) : value;
    return high > low ? first + (v - low) / (high - low) * (last - first) : first;
  }
  std::vector<double> Ticks() const {
    constexpr int kTicks = 5;
    if (!is_log) return RoundTicks(low, high, kTicks);
    // Powers of ten; over a short range their twofold and fivefold, too.
    std::vector<double> ticks;
    const double step = std::max(1.0, std::ceil((high - low) / kTicks));
    const std::vector<double> factors =
        high - low < 2.0 ? std::vector<double>{1.0, 2.0, 5.0} : std::vector<double>{1.0};
    for (double power = std::floor(low); power <= high; power += step) {
      for (const double factor : factors) {
        const double tick = factor * std::pow(10.0, power);
        if (std::log10(tick) >= low && std::log10(tick) <= high) ticks.push_back(tick);
      }
    }
    return ticks;
  }
};

std::string DrawAxes(const Axis& x, const Axis& y, const PlotLabels& labels) {
  std::string svg;
  for (const double tick : y.Ticks()) {
    const double at = y.At(tick);
    svg += Line(x.first, at, x.last, at, "grid");
    svg += Text(x.first - 8.0, at + 4.0, "end", TickText(tick));
  }
  for (const double tick : x.Ticks()) {
    const double at = x.At(tick);
    svg += Line(at, y.first, at, y.first + kTickLength, "axis");
    svg += Text(at, y.first + 18.0, "middle", TickText(tick));
  }
  svg += Line(x.first, y.first, x.last, y.first, "axis");
  svg += Text(0.5 * (x.first + x.last), y.first + 38.0, "middle", labels.x);
  svg += "<text transform=\"translate(14 " + Number(0.5 * (y.first + y.last)) +
         ") rotate(-90)\" text-anchor=\"middle\">" + EscapeHtml(labels.y) + "</text>\n";
  return svg;
}

bool IsShown(double x, double y, const PlotScales& scales) {
  return std::isfinite(x) && std::isfinite(y) && (!scales.log_x || x > 0.0) &&
         (!scales.log_y || y > 0.0);
}

// Widens an empty range.
void Widen(Axis* axis) {
  if (axis->high > axis->low) return;
  axis->high = axis->low + (axis->low != 0.0 ? std::abs(axis->low) : 1.0);
}

std::string DrawSeries(const PlotSeries& series, const Axis& x, const Axis& y, int number) {
  std::string points;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!IsShown(series.x[i], series.y[i], {x.is_log, y.is_log})) continue;
    points += Number(x.At(series.x[i])) + "," + Number(y.At(series.y[i])) + " ";
  }
  return "<polyline class=\"series s" + std::to_string(number % kNumStyles) + "\" points=\"" +
         points + "\"/>\n";
}

// Returns the names of the series in two columns, from `top` downwards.
std::string DrawLegend(const std::vector<PlotSeries>& series, double top) {
  constexpr double kSample = 30.0;
  constexpr double kColumn = 0.5 * (kWidth - kLeft - kRight);
  std::string svg;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::size_t row = i / 2;
    const double y = top + kLegendRow * static_cast<double>(row);
    const double x = kLeft + kColumn * static_cast<double>(i % 2);
    const std::string style = "series s" + std::to_string(i % kNumStyles);
    svg += Line(x, y, x + kSample, y, style.c_str());
    svg += Text(x + kSample + 6.0, y + 4.0, "start", series[i].name);
  }
  return svg;
}

}  // namespace

std::string LinePlot(const PlotLabels& labels,
                     const std::vector<PlotSeries>& series,
                     const PlotScales& scales) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool has_legend = series.size() > 1;
  const std::size_t legend_rows = (series.size() + 1) / 2;
  const double legend = has_legend ? kLegendRow * static_cast<double>(legend_rows) + 4.0 : 0.0;
  Axis x = {kInfinity, -kInfinity, kLeft, kWidth - kRight, scales.log_x};
  Axis y = {kInfinity, -kInfinity, kHeight + legend - kBottom, kTop + legend, scales.log_y};
  for (const PlotSeries& one : series) {
    for (std::size_t i = 0; i < one.x.size(); ++i) {
      if (!IsShown(one.x[i], one.y[i], scales)) continue;
      const double across = scales.log_x ? std::log10(one.x[i]) : one.x[i];
      const double height = scales.log_y ? std::log10(one.y[i]) : one.y[i];
      x.low = std::min(x.low, across);
      x.high = std::max(x.high, across);
      y.low = std::min(y.low, height);
      y.high = std::max(y.high, height);
    }
  }
  if (x.high < x.low) return "";
  if (!scales.log_y) y.low = std::min(y.low, 0.0);
  if (scales.frames) {
    x.low = scales.frames->first;
    x.high = scales.frames->last;
  }
  Widen(&x);
  Widen(&y);
  const bool of_frames = scales.frames.has_value();
  std::string svg = Open(labels,
                         kHeight + legend,
                         of_frames ? kFramesClass : "",
                         of_frames ? FrameData(*scales.frames, x.first, x.last) : "") +
                    DrawAxes(x, y, labels);
  if (of_frames) svg += Line(x.last, y.first, x.last, y.last, "now");
  for (std::size_t i = 0; i < series.size(); ++i) {
    svg += DrawSeries(series[i], x, y, static_cast<int>(i));
  }
  if (has_legend) svg += DrawLegend(series, kTop);
  return svg + "</svg>\n";
}

HistogramBins CountBins(const std::vector<double>& values, int bins) {
  constexpr double kShare = 0.99;
  std::vector<double> known;
  for (const double value : values) {
    if (std::isfinite(value)) known.push_back(value);
  }
  HistogramBins histogram;
  histogram.counts.assign(bins, 0);
  if (known.empty()) return histogram;
  std::sort(known.begin(), known.end());
  histogram.high = known[static_cast<std::size_t>(kShare * static_cast<double>(known.size() - 1))];
  if (histogram.high == 0.0) histogram.high = known.back();
  for (const double value : known) {
    if (value > histogram.high) {
      ++histogram.beyond;
      continue;
    }
    const double part = histogram.high > 0.0 ? value / histogram.high : 0.0;
    ++histogram.counts[std::clamp(static_cast<int>(part * bins), 0, bins - 1)];
  }
  return histogram;
}

std::string HistogramPlot(const PlotLabels& labels, const HistogramBins& bins) {
  const int most = *std::max_element(bins.counts.begin(), bins.counts.end());
  if (most == 0) return "";
  const double high = bins.high > 0.0 ? bins.high : 1.0;
  const Axis x = {bins.low, high, kLeft, kWidth - kRight, false};
  const Axis y = {0.0, static_cast<double>(most), kHeight - kBottom, kTop, false};
  std::string svg = Open(labels, kHeight) + DrawAxes(x, y, labels);
  const double width = (x.last - x.first) / static_cast<double>(bins.counts.size());
  for (std::size_t i = 0; i < bins.counts.size(); ++i) {
    if (bins.counts[i] == 0) continue;
    const double top = y.At(bins.counts[i]);
    svg += "<rect class=\"bar\" x=\"" + Number(x.first + width * static_cast<double>(i)) +
           "\" y=\"" + Number(top) + "\" width=\"" + Number(std::max(width - 1.0, 0.5)) +
           "\" height=\"" + Number(y.first - top) + "\"/>\n";
  }
  return svg + "</svg>\n";
}

PlotSeries CumulativeSeries(const std::string& name, std::vector<double> values) {
  constexpr int kSteps = 200;
  constexpr double kPercent = 100.0;
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }),
               values.end());
  PlotSeries series;
  series.name = name;
  if (values.empty()) return series;
  std::sort(values.begin(), values.end());
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    series.x.push_back(
        values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))]);
    series.y.push_back(kPercent * share);
  }
  return series;
}

namespace {

// A status with its sign and class of the style sheet.
struct StatusLook {
  const char* name;
  const char* sign;
  const char* style;
};

constexpr StatusLook kStatuses[] = {{"initialized", "I", "st0"},
                                    {"tracked", "", "st1"},
                                    {"relocalized", "R", "st2"},
                                    {"lost", "L", "st3"},
                                    {"skipped", "S", "st4"}};

const StatusLook& LookOf(const std::string& status) {
  for (const StatusLook& look : kStatuses) {
    if (status == look.name) return look;
  }
  return kStatuses[4];
}

std::string Box(double x, double y, double width, double height, const char* style) {
  return "<rect class=\"" + std::string(style) + "\" x=\"" + Number(x) + "\" y=\"" + Number(y) +
         "\" width=\"" + Number(width) + "\" height=\"" + Number(height) + "\"/>\n";
}

// Returns a sample of each status that occurs, with its sign, name and number of frames.
std::string StatusLegend(const std::vector<std::string>& statuses, double y) {
  std::string svg;
  double x = kLeft;
  for (const StatusLook& look : kStatuses) {
    const auto count = std::count(statuses.begin(), statuses.end(), look.name);
    if (count == 0) continue;
    const std::string sign = *look.sign == '\0' ? "" : std::string(look.sign) + ": ";
    const std::string text = sign + look.name + " (" + std::to_string(count) + ")";
    constexpr double kSample = 14.0;
    constexpr double kCharacter = 7.4;
    svg += Box(x, y - kSample + 2.0, kSample, kSample, look.style);
    svg += Text(x + kSample + 5.0, y, "start", text);
    x += kSample + 16.0 + kCharacter * static_cast<double>(text.size());
  }
  return svg;
}

}  // namespace

std::string StatusStrip(const std::string& description,
                        const std::vector<int>& numbers,
                        const std::vector<std::string>& statuses) {
  if (numbers.empty()) return "";
  constexpr double kStripTop = 18.0;
  constexpr double kStripHeight = 26.0;
  constexpr double kTotal = 104.0;
  Axis x = {1.0 * numbers.front(), 1.0 * numbers.back(), kLeft, kWidth - kRight, false};
  Widen(&x);
  const FrameRange frames = {numbers.front(), numbers.back()};
  std::string svg =
      Open({"", "", description}, kTotal, kFramesClass, FrameData(frames, x.first, x.last));
  const double half = 0.5 * (x.last - x.first) / std::max(1.0, x.high - x.low);
  double last_sign = -kWidth;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i;
    while (end + 1 < numbers.size() && statuses[end + 1] == statuses[i]) ++end;
    const StatusLook& look = LookOf(statuses[i]);
    const double from = std::max(x.first, x.At(numbers[i]) - half);
    const double to = std::min(x.last, x.At(numbers[end]) + half);
    svg += Box(from, kStripTop, std::max(to - from, 1.0), kStripHeight, look.style);
    const double middle = 0.5 * (from + to);
    constexpr double kApart = 10.0;
    if (*look.sign != '\0' && middle - last_sign > kApart) {
      svg += Text(middle, kStripTop - 5.0, "middle", look.sign);
      last_sign = middle;
    }
    i = end + 1;
  }
  const double bottom = kStripTop + kStripHeight;
  for (const double tick : x.Ticks()) {
    svg += Line(x.At(tick), bottom, x.At(tick), bottom + kTickLength, "axis");
    svg += Text(x.At(tick), bottom + 18.0, "middle", TickText(tick));
  }
  svg += Text(x.first - 8.0, kStripTop + 17.0, "end", "status");
  svg += Line(x.last, kStripTop - 3.0, x.last, bottom + 3.0, "now");
  return svg + StatusLegend(statuses, kTotal - 8.0) + "</svg>\n";
}

std::string BarPlot(const PlotLabels& labels, const std::vector<PlotBar>& bars) {
  constexpr double kRow = 24.0;
  constexpr double kNames = 150.0;
  constexpr double kValues = 90.0;
  double most = 0.0;
  for (const PlotBar& bar : bars) most = std::max(most, bar.value);
  if (!(most > 0.0)) return "";
  const double height = kRow * static_cast<double>(bars.size()) + 8.0;
  std::string svg = Open(labels, height);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double y = kRow * static_cast<double>(i) + 6.0;
    const double length = (kWidth - kNames - kValues) * std::max(bars[i].value, 0.0) / most;
    svg += Text(kNames - 8.0, y + 13.0, "end", bars[i].name);
    svg += "<rect class=\"bar\" x=\"" + Number(kNames) + "\" y=\"" + Number(y) + "\" width=\"" +
           Number(std::max(length, 0.5)) + "\" height=\"" + Number(kRow - 8.0) + "\"/>\n";
    svg += Text(kNames + length + 6.0, y + 13.0, "start", bars[i].text);
  }
  return svg + "</svg>\n";
}

}  // namespace ceres_ed
