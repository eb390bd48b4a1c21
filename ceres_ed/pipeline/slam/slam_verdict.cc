#include "ceres_ed/pipeline/slam/slam_verdict.h"

#include <ceres_ed/pipeline/slam/frame_records.h>
#include <ceres_ed/util/statistics.h>

#include <cmath>
#include <string>
#include <utility>

namespace ceres_ed {
namespace {

std::string Percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

// What can be seen of a run without truth.
struct RunFigures {
  double frames = 0.0;
  double lost = 0.0;
  double relocalized = 0.0;
  // The number of tracked frames, and the number of these that leave a direction undetermined.
  double tracked = 0.0;
  double weak = 0.0;
  // Medians of the tracked frames; the residual in node spacings.
  double overlap = 0.0;
  double explained = 0.0;
  double tentative = 0.0;
  double residual = 0.0;
};

RunFigures FiguresOf(const std::vector<FrameRecord>& records, double node_spacing) {
  RunFigures run;
  run.frames = static_cast<double>(records.size());
  std::vector<double> overlaps, explained, tentative, residuals;
  for (const FrameRecord& record : records) {
    run.lost += HasPose(record) ? 0.0 : 1.0;
    run.relocalized += Is(record, FrameStatus::kRelocalized) ? 1.0 : 0.0;
    if (!HasPose(record) || !Is(record, FrameStatus::kTracked)) continue;
    run.tracked += 1.0;
    run.weak += record["weak_directions"] > 0.0 ? 1.0 : 0.0;
    overlaps.push_back(record["overlap"]);
    explained.push_back(record["explained"]);
    tentative.push_back(record["tentative"]);
    residuals.push_back(record["rms_plane"] / node_spacing);
  }
  run.overlap = Median(std::move(overlaps));
  run.explained = Median(std::move(explained));
  run.tentative = Median(std::move(tentative));
  run.residual = Median(std::move(residuals));
  return run;
}

std::string Count(double number) { return std::to_string(std::lround(number)); }

// One figure of the verdict. Larger values are worse if `bad` is larger than `doubtful`.
struct Rule {
  const char* code;
  double (*value)(const RunFigures& run);
  // The bounds between good and doubtful, and between doubtful and bad.
  double doubtful;
  double bad;
  std::string (*text)(const RunFigures& run);
  const char* advice;
};

// A frame is lost for a moment behind a tool or in smoke; a run that has lost a fifth of its frames
// does not show the tissue. Shares never reach the bound 1.1.
const Rule kRules[] = {
    {"lost_frames",
     [](const RunFigures& run) { return run.lost / run.frames; },
     0.02,
     0.2,
     [](const RunFigures& run) {
       return "the camera was lost in, or there was no depth in, " + Count(run.lost) + " of " +
              Count(run.frames) + " frames";
     },
     "see the status of the frames in frames.csv; use more frames per second, or --first and "
     "--last"},
    {"relocalized_frames",
     [](const RunFigures& run) { return run.relocalized / run.frames; },
     0.01,
     0.05,
     [](const RunFigures& run) {
       return "the camera jumped in " + Count(run.relocalized) + " frames";
     },
     "look at the trajectory where it jumps"},
    {"overlap",
     [](const RunFigures& run) { return run.overlap; },
     0.85,
     0.6,
     [](const RunFigures& run) {
       return "in the median " + Percent(1.0 - run.overlap) +
              " of the map in view does not lie on the measured surface";
     },
     "check the depth, or use a smaller --node_spacing"},
    {"explained",
     [](const RunFigures& run) { return run.explained; },
     0.6,
     0.3,
     [](const RunFigures& run) {
       return "in the median the map explains " + Percent(run.explained) +
              " of the measured surface";
     },
     "check the depth for noise and the masks for tools"},
    {"residual",
     [](const RunFigures& run) { return run.residual; },
     0.1,
     0.2,
     [](const RunFigures& run) {
       return "the map is " + Percent(run.residual) + " of a node spacing off the measured surface";
     },
     "use a smaller --node_spacing, or check the depth"},
    {"weak_directions",
     [](const RunFigures& run) { return run.weak / run.tracked; },
     0.2,
     1.1,
     [](const RunFigures& run) {
       return Percent(run.weak / run.tracked) +
              " of the frames do not determine the camera in every direction, in which it then "
              "stays still";
     },
     "use colour pictures, or --camera=given or --camera=fixed if the camera is known"},
    {"tentative_points",
     [](const RunFigures& run) { return run.tentative; },
     0.3,
     1.1,
     [](const RunFigures& run) {
       return "in the median " + Percent(run.tentative) +
              " of the points in view were seen only briefly";
     },
     "check the depth for noise"},
};

}  // namespace

Verdict JudgeRun(const std::vector<FrameRecord>& records, double node_spacing) {
  Verdict verdict;
  const RunFigures run = FiguresOf(records, node_spacing);
  if (run.tracked == 0.0) {
    if (run.frames > 1.0) {
      verdict.Add(Grade::kBad,
                  {"nothing_tracked", "no frame was tracked after the first one", 0.0, 1.0},
                  "check the intrinsics, the unit of the depth and the masks");
    }
    return verdict;
  }
  for (const Rule& rule : kRules) {
    verdict.Check(
        rule.value(run), {rule.doubtful, rule.bad}, rule.code, rule.text(run), rule.advice);
  }
  return verdict;
}

}  // namespace ceres_ed
