#include "apps/fit_text.h"

#include <ceres_ed/io/text.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <numeric>
#include <vector>

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

// Returns the errors of landmarks by name: in sum, and the largest ones.
std::string NamedLandmarksText(const FitRun& run) {
  const std::vector<LandmarkError> errors = MeasureNamedLandmarks(run);
  if (errors.empty()) return "";
  const LandmarkErrors before = SummarizeLandmarks(errors, &LandmarkError::before);
  const LandmarkErrors rigid = SummarizeLandmarks(errors, &LandmarkError::rigid);
  const LandmarkErrors after = SummarizeLandmarks(errors, &LandmarkError::after);
  const bool is_measured = run.settings->landmark_use == LandmarkUse::kMeasure;
  std::string text = Line("by name    %d landmarks%s, target units",
                          after.count,
                          is_measured ? ", not used by the fit" : "") +
                     Line("           %10s %10s %10s", "before", "rigid", "after") +
                     Line("  rms      %10.4g %10.4g %10.4g", before.rms, rigid.rms, after.rms) +
                     Line("  max      %10.4g %10.4g %10.4g", before.max, rigid.max, after.max);
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&errors](std::size_t a, std::size_t b) {
    return errors[a].after > errors[b].after;
  });
  constexpr std::size_t kRows = 3;
  for (std::size_t i = 0; i < std::min(kRows, order.size()); ++i) {
    const LandmarkError& error = errors[order[i]];
    text += Line("           %10.4g %10.4g %10.4g  %s",
                 error.before,
                 error.rigid,
                 error.after,
                 Quoted(run.files->named.pairs[order[i]].name).c_str());
  }
  return text;
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
  if (const LandmarkErrors errors = MeasureLandmarks(run);
      errors.count > 0 && !run.settings->landmarks.empty()) {
    summary += Line(
        "landmarks  %d, rms %.4g, max %.4g, target units", errors.count, errors.rms, errors.max);
  }
  summary += NamedLandmarksText(run);
  if (const std::size_t fixed = run.files->input.fixed_points.size(); fixed > 0) {
    summary += Line("fixed      %zu, max %.4g, target units", fixed, result.max_fixed_error);
  }
  return summary + Line("time       %.2f s", run.total_s) + "output     " + run.settings->output +
         "\nverdict    " + run.verdict.Sentence() + "\n";
}

}  // namespace ceres_ed
