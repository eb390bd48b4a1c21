#include "ceres_ed/report/html/sequence_page.h"

#include <ceres_ed/report/html/about.h>
#include <ceres_ed/report/html/page.h>
#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/html/run_sections.h>
#include <ceres_ed/report/html/svg_plot.h>
#include <ceres_ed/report/html/timeline_section.h>
#include <ceres_ed/report/html/viewer.h>
#include <ceres_ed/report/view/number_text.h>

#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

constexpr double kMilli = 1000.0;

void AddSummary(const ordered_json& report, const SequenceView& view, HtmlPage* page) {
  std::vector<std::string> lines;
  const std::string status = TextOf(report, {"status"});
  if (!status.empty()) {
    lines.push_back("Status: " + status + " (" + TextOf(report, {"message"}) + ").");
  }
  const std::string path = TextOf(report, {"sequence", "path"});
  if (!path.empty()) {
    lines.push_back("Sequence: " + path + "; " + TextOf(report, {"sequence", "description"}) + ".");
  }
  const ordered_json& nodes = MemberOf(report, {"nodes"});
  if (nodes.is_object()) {
    lines.push_back("Map at the end: " + ValueText(MemberOf(report, {"map", "points"})) +
                    " points, " + ValueText(MemberOf(nodes, {"total"})) + " nodes, " +
                    ValueText(MemberOf(nodes, {"edges"})) + " edges, a node each " +
                    ShortNumber(kMilli * NumberOf(report, {"map", "node_spacing"})) + " mm.");
  }
  if (MemberOf(report, {"memory_peak_mib"}).is_number()) {
    lines.push_back("Memory at its peak: " + ShortNumber(NumberOf(report, {"memory_peak_mib"})) +
                    " MiB.");
  }
  lines.push_back(view.live_clouds > 0
                      ? "Live clouds: " + std::to_string(view.live_clouds) + " frames."
                      : "There are no live clouds (--live_every), so the points of the map stand "
                        "still where they are at the end, and appear when they were first seen.");
  page->Subsection("Run");
  page->List(lines);
}

// Adds the distances from the truth over the frames that are shown.
void AddErrors(const SequenceView& view, HtmlPage* page) {
  if (view.errors.empty()) return;
  page->Section("Errors");
  PlotSeries mean = {"mean", {}, {}}, median = {"median", {}, {}}, high = {"95 %", {}, {}};
  HtmlTable table = {"Distance of map points to their true places in mm",
                     {"frame", "mean", "median", "95 %"},
                     {},
                     1};
  for (const MomentError& error : view.errors) {
    for (const auto& [series, value] : {std::pair(&mean, error.mean),
                                        std::pair(&median, error.median),
                                        std::pair(&high, error.p95)}) {
      series->x.push_back(error.frame);
      series->y.push_back(kMilli * value);
    }
    table.rows.push_back({std::to_string(error.frame),
                          ShortNumber(kMilli * error.mean),
                          ShortNumber(kMilli * error.median),
                          ShortNumber(kMilli * error.p95)});
  }
  PlotScales scales;
  if (!view.log.frames.empty()) {
    scales.frames = FrameRange{view.log.frames.front(), view.log.frames.back()};
  }
  page->Plot(LinePlot({"frame",
                       "distance to the true place [mm]",
                       "Distances of map points to their true places over the frames"},
                      {mean, median, high},
                      scales),
             "How far the points of the map are from where their tissue is, in the camera frame.");
  page->FoldedTable("Figures of the errors", table);
}

// Adds the figures of ed_eval: each summary as a table.
void AddEvaluation(const ordered_json& evaluation, HtmlPage* page) {
  HtmlTable table = {"Figures of ed_eval; lengths in mm, shares without unit",
                     {"measure", "figure", "mean", "median", "max"},
                     {},
                     2};
  for (const char* const part : {"truth", "depth"}) {
    const ordered_json& summary = MemberOf(evaluation, {part, "summary"});
    if (!summary.is_object()) continue;
    for (const auto& [name, figure] : summary.items()) {
      const double factor = name.find("share") == std::string::npos ? kMilli : 1.0;
      table.rows.push_back({part,
                            name,
                            ShortNumber(factor * NumberOf(figure, {"mean"})),
                            ShortNumber(factor * NumberOf(figure, {"median"})),
                            ShortNumber(factor * NumberOf(figure, {"max"}))});
    }
  }
  HtmlTable camera = {
      "Camera and tracks, as ed_eval has them", {"measure", "figure", "value"}, {}, 2};
  const std::pair<const char*, const ordered_json*> parts[] = {
      {"camera, from the first frame", &MemberOf(evaluation, {"camera", "from_first_frame"})},
      {"camera, best alignment", &MemberOf(evaluation, {"camera", "best_alignment"})},
      {"tracks in the pictures", &MemberOf(evaluation, {"tracks_2d"})}};
  for (const auto& [part, place] : parts) {
    const ordered_json& figures = *place;
    if (!figures.is_object()) continue;
    for (const auto& [name, value] : figures.items()) {
      if (value.is_number()) camera.rows.push_back({part, name, ValueText(value)});
      if (!value.is_object()) continue;
      for (const auto& [inner, number] : value.items()) {
        if (number.is_number())
          camera.rows.push_back({part, name + " " + inner, ValueText(number)});
      }
    }
  }
  if (table.rows.empty() && camera.rows.empty()) return;
  page->Section("Evaluation");
  page->Table(table);
  page->Table(camera);
}

void AddTracks(const Scene& scene, HtmlPage* page) {
  if (!scene.timeline || scene.timeline->tracks.empty()) return;
  page->Section("Tracks");
  HtmlTable table = {"Points that were chosen, over the frames that are shown",
                     {"point", "frames", "way [mm]", "from begin to end [mm]"},
                     {},
                     1};
  for (const ViewTrack& track : scene.timeline->tracks) {
    double way = 0.0;
    for (std::size_t i = 1; i < track.places.size(); ++i) {
      way += (track.places[i] - track.places[i - 1]).norm();
    }
    table.rows.push_back(
        {std::to_string(track.id),
         std::to_string(track.places.size()),
         ShortNumber(kMilli * way),
         ShortNumber(kMilli * (track.places.back() - track.places.front()).norm())});
  }
  page->FoldedTable("Ways of " + std::to_string(table.rows.size()) + " points", table);
}

}  // namespace

std::string SequenceTitle(const ordered_json& report) {
  std::string path = TextOf(report, {"sequence", "path"});
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  const std::size_t slash = path.find_last_of('/');
  if (slash != std::string::npos && slash + 1 < path.size()) path = path.substr(slash + 1);
  const ordered_json& frames = MemberOf(report, {"frames", "processed"});
  const std::string count = frames.is_number() ? ", " + ValueText(frames) + " frames" : "";
  return (path.empty() ? "Sequence" : path) + count;
}

std::string SequencePage(const ordered_json& report,
                         const ordered_json& evaluation,
                         const SequenceView& view,
                         const std::string& picture_png) {
  HtmlPage page(SequenceTitle(report));
  AddVerdict(report, &page);
  AddSummary(report, view, &page);
  page.Section("View");
  AddViewer(view.scene, picture_png, &page);
  AddTimeline(view.log, &page);
  AddErrors(view, &page);
  AddEvaluation(evaluation, &page);
  AddVerification(view.log, &page);
  AddTracks(view.scene, &page);
  AddFrameTimes(report, &page);
  AddFlags(report, &page);
  AddAbout(report, &page);
  return page.Finish();
}

}  // namespace ceres_ed
