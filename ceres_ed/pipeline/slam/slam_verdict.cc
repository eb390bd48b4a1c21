#include "ceres_ed/pipeline/slam/slam_verdict.h"

#include <ceres_ed/pipeline/slam/frame_records.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ceres_ed {
namespace {

// Bounds between good and doubtful, and between doubtful and bad. A frame is lost for a moment
// behind a tool or in smoke; a run that has lost a fifth of its frames does not show the tissue.
constexpr double kLostShare[] = {0.02, 0.2};
constexpr double kRelocalizedShare[] = {0.01, 0.05};
constexpr double kOverlap[] = {0.85, 0.6};
constexpr double kExplained[] = {0.6, 0.3};
constexpr double kWeakShare[] = {0.2, 1.1};
constexpr double kTentative[] = {0.3, 1.1};
// In node spacings.
constexpr double kResidual[] = {0.1, 0.2};

std::string Percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

// Adds a reason if `value` is beyond the bounds, of which larger ones are worse if the second one
// is larger.
void Check(double value,
           const double (&bounds)[2],
           const std::string& code,
           const std::string& text,
           const std::string& advice,
           Verdict* verdict) {
  const double sign = bounds[1] > bounds[0] ? 1.0 : -1.0;
  if (!(sign * value > sign * bounds[0])) return;
  const Grade grade = sign * value > sign * bounds[1] ? Grade::kBad : Grade::kDoubtful;
  verdict->Add(grade, {code, text, value, bounds[0]}, advice);
}

}  // namespace

Verdict JudgeRun(const std::vector<FrameRecord>& records, double node_spacing) {
  Verdict verdict;
  const auto frames = static_cast<double>(records.size());
  int lost = 0, weak = 0, relocalized = 0;
  std::vector<double> overlaps, explained, tentative, residuals;
  for (const FrameRecord& record : records) {
    if (!HasPose(record)) {
      ++lost;
      continue;
    }
    if (Is(record, FrameStatus::kRelocalized)) ++relocalized;
    if (!Is(record, FrameStatus::kTracked)) continue;
    if (record["weak_directions"] > 0.0) ++weak;
    overlaps.push_back(record["overlap"]);
    explained.push_back(record["explained"]);
    tentative.push_back(record["tentative"]);
    residuals.push_back(record["rms_plane"] / node_spacing);
  }
  if (overlaps.empty()) {
    if (frames > 1.0) {
      verdict.Add(Grade::kBad,
                  {"nothing_tracked", "no frame was tracked after the first one", 0.0, 1.0},
                  "check the intrinsics, the unit of the depth and the masks");
    }
    return verdict;
  }
  const auto tracked = static_cast<double>(overlaps.size());
  Check(lost / frames,
        kLostShare,
        "lost_frames",
        "the camera was lost in, or there was no depth in, " + std::to_string(lost) + " of " +
            std::to_string(records.size()) + " frames",
        "see the status of the frames in frames.csv; use more frames per second, or --first and "
        "--last",
        &verdict);
  Check(relocalized / frames,
        kRelocalizedShare,
        "relocalized_frames",
        "the camera jumped in " + std::to_string(relocalized) + " frames",
        "look at the trajectory where it jumps",
        &verdict);
  const double overlap = Median(overlaps);
  Check(overlap,
        kOverlap,
        "overlap",
        "in the median " + Percent(1.0 - overlap) +
            " of the map in view does not lie on the measured surface",
        "check the depth, or use a smaller --node_spacing",
        &verdict);
  const double share = Median(explained);
  Check(share,
        kExplained,
        "explained",
        "in the median the map explains " + Percent(share) + " of the measured surface",
        "check the depth for noise and the masks for tools",
        &verdict);
  const double residual = Median(residuals);
  Check(residual,
        kResidual,
        "residual",
        "the map is " + Percent(residual) + " of a node spacing off the measured surface",
        "use a smaller --node_spacing, or check the depth",
        &verdict);
  Check(weak / tracked,
        kWeakShare,
        "weak_directions",
        Percent(weak / tracked) +
            " of the frames do not determine the camera in every direction, in which it then stays "
            "still",
        "use colour pictures, or --camera=given or --camera=fixed if the camera is known",
        &verdict);
  const double uncertain = Median(tentative);
  Check(uncertain,
        kTentative,
        "tentative_points",
        "in the median " + Percent(uncertain) + " of the points in view were seen only briefly",
        "check the depth for noise",
        &verdict);
  return verdict;
}

}  // namespace ceres_ed
