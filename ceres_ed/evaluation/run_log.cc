#include "ceres_ed/evaluation/run_log.h"

#include <cmath>
#include <cstddef>
#include <optional>

namespace ceres_ed {

LogSummary SummarizeLog(const FrameLog& log) {
  LogSummary summary;
  for (const std::string& status : log.statuses) ++summary.frames_by_status[status];
  const std::vector<double>* const inliers = log.Find("inliers");
  for (const auto& [name, values] : log.columns) {
    const bool is_rms = name == "rms_plane";
    std::vector<std::optional<double>> present;
    for (std::size_t r = 0; r < values.size(); ++r) {
      if (is_rms && inliers != nullptr && (*inliers)[r] == 0.0) continue;
      if (std::isfinite(values[r])) present.emplace_back(values[r]);
    }
    if (present.empty()) continue;
    if (is_rms) {
      summary.rms_plane = SummarizeFrames(present);
      summary.rms_plane_last = *present.back();
    } else if (name.rfind("t_", 0) == 0) {
      summary.median_times_s.push_back({name, SummarizeFrames(present).median});
    } else if (name == "nodes" || name == "pr" || name == "map_points") {
      summary.at_the_end.push_back({name, *present.back()});
    }
  }
  return summary;
}

}  // namespace ceres_ed
