#include "ceres_ed/report/html/timeline_section.h"

#include <ceres_ed/report/html/svg_plot.h>
#include <ceres_ed/report/view/number_text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ceres_ed {
namespace {

constexpr double kMilli = 1000.0;
constexpr double kPercent = 100.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A line of a plot: a column of frames.csv.
struct FrameLine {
  const char* column;
  const char* name;
};

// Up to three lines with one axis.
struct FramePlot {
  const char* axis;
  const char* words;
  double factor;
  std::vector<FrameLine> lines;
};

const std::vector<FramePlot>& FramePlots() {
  static const std::vector<FramePlot> plots = {
      {"residual [mm]",
       "The rms distance of the measured surface from the map, along its normals.",
       kMilli,
       {{"rms_plane", "residual"}}},
      {"time [ms]",
       "The time of a frame, without reading and writing.",
       kMilli,
       {{"t_total", "time"}, {"t_stereo", "stereo"}}},
      {"nodes",
       "The nodes of the graph, those with data (PR), and those that Level I moved.",
       1.0,
       {{"nodes", "all"}, {"pr", "PR"}, {"active", "moved"}}},
      {"share [%]",
       "The share of the measured surface that the map explains, and of the map in view that lies "
       "on it.",
       kPercent,
       {{"explained", "explained"}, {"overlap", "overlap"}, {"foreground", "tools"}}},
      {"weak directions",
       "The directions of the camera's motion, of 6, that the frame does not determine.",
       1.0,
       {{"weak_directions", "weak directions"}}},
      {"points",
       "The points of the map, and those of them that have a counterpart in the frame.",
       1.0,
       {{"map_points", "map"}, {"points", "matched"}}}};
  return plots;
}

bool HasPose(const std::string& status) { return status != "lost" && status != "skipped"; }

// Returns a column over the frames; frames without a known camera have gaps. Empty if the log has
// no such column, or nothing in it.
PlotSeries SeriesOf(const FrameLog& log,
                    const char* column,
                    double factor,
                    const std::string& name) {
  PlotSeries series = {name, {}, {}};
  const std::vector<double>* const values = log.Find(column);
  if (values == nullptr) return series;
  bool is_known = false;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    double value = HasPose(log.statuses[i]) ? factor * (*values)[i] : kNan;
    // The frame that begins the map is compared with nothing.
    if (log.statuses[i] == "initialized" && value == 0.0) value = kNan;
    series.x.push_back(log.frames[i]);
    series.y.push_back(value);
    is_known = is_known || std::isfinite(value);
  }
  return is_known ? series : PlotSeries{name, {}, {}};
}

// Returns the frames of a log, which has some.
FrameRange RangeOf(const FrameLog& log) {
  const auto [first, last] = std::minmax_element(log.frames.begin(), log.frames.end());
  return {*first, *last};
}

void AddFramePlot(const FramePlot& plot, const FrameLog& log, HtmlPage* page) {
  std::vector<PlotSeries> series;
  for (const FrameLine& line : plot.lines) {
    PlotSeries one = SeriesOf(log, line.column, plot.factor, line.name);
    if (!one.x.empty()) series.push_back(std::move(one));
  }
  if (series.empty()) return;
  PlotScales scales;
  scales.frames = RangeOf(log);
  const std::string words = plot.words;
  page->Plot(LinePlot({"frame", plot.axis, words + " The table has the figures."}, series, scales),
             words);
}

// A column of the table of frames.
struct TableColumn {
  const char* column;
  const char* head;
  double factor;
};

constexpr TableColumn kColumns[] = {{"rms_plane", "residual [mm]", kMilli},
                                    {"t_total", "time [ms]", kMilli},
                                    {"nodes", "nodes", 1.0},
                                    {"pr", "PR", 1.0},
                                    {"map_points", "map points", 1.0},
                                    {"explained", "explained [%]", kPercent},
                                    {"overlap", "overlap [%]", kPercent},
                                    {"weak_directions", "weak directions", 1.0}};

void AddFrameTable(const FrameLog& log, HtmlPage* page) {
  // More rows would make a page slow.
  constexpr std::size_t kMost = 1000;
  const std::size_t step = (log.frames.size() + kMost - 1) / kMost;
  HtmlTable table = {"Figures of the frames", {"frame", "status"}, {}, 2};
  for (const TableColumn& column : kColumns) {
    if (log.Find(column.column) != nullptr) table.head.emplace_back(column.head);
  }
  for (std::size_t i = 0; i < log.frames.size(); i += step) {
    std::vector<std::string> row = {std::to_string(log.frames[i]), log.statuses[i]};
    for (const TableColumn& column : kColumns) {
      const std::vector<double>* const values = log.Find(column.column);
      if (values != nullptr) row.push_back(ShortNumber(column.factor * (*values)[i], 4));
    }
    table.rows.push_back(std::move(row));
  }
  const std::string which = step > 1 ? "every " + std::to_string(step) + "th of the" : "all";
  page->FoldedTable("Figures of " + which + " " + std::to_string(log.frames.size()) +
                        " frames (frames.csv has more)",
                    table);
}

}  // namespace

void AddTimeline(const FrameLog& log, HtmlPage* page) {
  if (log.frames.empty()) return;
  page->Section("Frames");
  page->Paragraph("A click on a frame shows it in the view above.");
  page->Plot(StatusStrip("Status of each frame; the table has it, too", log.frames, log.statuses),
             "What became of each frame: I begins the map, R was found again after a jump, L is "
             "lost, S shows nothing that could be used; all others were tracked.");
  page->Html("<div class=\"plots\">\n");
  for (const FramePlot& plot : FramePlots()) AddFramePlot(plot, log, page);
  page->Html("</div>\n");
  AddFrameTable(log, page);
}

void AddVerification(const FrameLog& log, HtmlPage* page) {
  const PlotSeries gap = SeriesOf(log, "verify_gap", kPercent, "gap");
  if (gap.x.empty()) return;
  page->Section("Two levels against batch");
  page->Paragraph(
      "Some frames were solved a second time with all nodes at once (--verify_every). The gap is "
      "how much higher the energy of two levels is.");
  PlotSeries shown = {gap.name, {}, {}};
  HtmlTable table = {"Frames that were compared",
                     {"frame", "gap [%]", "nodes, mean [mm]", "nodes, max [mm]", "camera [mm]"},
                     {},
                     1};
  for (std::size_t i = 0; i < gap.x.size(); ++i) {
    if (!std::isfinite(gap.y[i])) continue;
    shown.x.push_back(gap.x[i]);
    shown.y.push_back(gap.y[i]);
    const auto figure = [&](const char* column) {
      const std::vector<double>* const values = log.Find(column);
      return values == nullptr ? "-" : ShortNumber(kMilli * (*values)[i]);
    };
    table.rows.push_back({std::to_string(log.frames[i]),
                          ShortNumber(gap.y[i]),
                          figure("verify_node_mean"),
                          figure("verify_node_max"),
                          figure("verify_camera_m")});
  }
  PlotScales scales;
  scales.frames = RangeOf(log);
  page->Plot(LinePlot({"frame", "gap [%]", "The gap to batch over the frames"}, {shown}, scales),
             "The energy of two levels above that of batch, in percent.");
  page->FoldedTable("Figures of the comparison", table);
}

void AddTimelines(const std::vector<std::pair<std::string, const FrameLog*>>& runs,
                  HtmlPage* page) {
  page->Section("Frames");
  page->Html("<div class=\"plots\">\n");
  for (const FramePlot& plot : FramePlots()) {
    std::vector<PlotSeries> series;
    for (const auto& [name, log] : runs) {
      PlotSeries one = SeriesOf(*log, plot.lines[0].column, plot.factor, name);
      if (!one.x.empty()) series.push_back(std::move(one));
    }
    const std::string words = plot.words;
    page->Plot(LinePlot({"frame", plot.axis, words}, series), words);
  }
  page->Html("</div>\n");
}

}  // namespace ceres_ed
