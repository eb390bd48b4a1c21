// Summarises the log of a run.
#ifndef CERES_ED_EVALUATION_RUN_LOG_H_
#define CERES_ED_EVALUATION_RUN_LOG_H_

#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/io/results/frames_csv.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// The summary of a log.
struct LogSummary {
  // The number of frames with each status.
  std::map<std::string, int> frames_by_status;
  // The root mean square plane distance over the frames that have one and have inliers, and its
  // last value; in metres.
  AcrossFrames rms_plane;
  double rms_plane_last = 0.0;
  // The median of every column t_..., by its name, in seconds.
  std::vector<std::pair<std::string, double>> median_times_s;
  // nodes, pr and map_points of the last row that contains them.
  std::vector<std::pair<std::string, double>> at_the_end;
};

// Returns the summary of a log; parts whose columns are missing are empty or zero.
LogSummary SummarizeLog(const FrameLog& log);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_RUN_LOG_H_
