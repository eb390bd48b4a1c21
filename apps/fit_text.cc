#include "apps/fit_text.h"

#include <cstddef>
#include <cstdio>

namespace ceres_ed {
namespace {

template <typename... Arguments>
std::string Line(const char* format, Arguments... arguments) {
  char text[256];
  std::snprintf(text, sizeof(text), format, arguments...);
  return std::string(text) + "\n";
}

// Returns how the fit ended, in one word.
const char* EndWord(SolveStatus status) {
  switch (status) {
    case SolveStatus::kConverged:
    case SolveStatus::kMaxIterations:
      return "done";
    case SolveStatus::kTimeLimit:
    case SolveStatus::kInterrupted:
      return "stopped";
    case SolveStatus::kFailed:
      break;
  }
  return "failed";
}

}  // namespace

std::string FitSummary(const FitRun& run) {
  const FitResult& result = *run.result;
  const int nodes = result.warp.graph.num_nodes();
  const int pr = NumPointRelevant(result);
  std::string summary = Line("status     %s: %s", EndWord(result.status), result.message.c_str()) +
                        Line("nodes      %d (%d PR, %d PI)", nodes, pr, nodes - pr);
  if (!run.files->target.path.empty()) {
    summary +=
        Line("inliers    %d of %d matches", result.matches.inliers, result.matches.candidates) +
        Line("rms        %.4g to planes, %.4g to points, target units",
             result.matches.rms_plane,
             result.matches.rms_point);
  }
  if (const LandmarkErrors errors = MeasureLandmarks(run); errors.count > 0) {
    summary += Line(
        "landmarks  %d, rms %.4g, max %.4g, target units", errors.count, errors.rms, errors.max);
  }
  if (const std::size_t fixed = run.files->input.fixed_points.size(); fixed > 0) {
    summary += Line("fixed      %zu, max %.4g, target units", fixed, result.max_fixed_error);
  }
  return summary + Line("time       %.2f s", run.total_s) + "output     " + run.settings->output +
         "\nverdict    " + run.verdict.Sentence() + "\n";
}

}  // namespace ceres_ed
