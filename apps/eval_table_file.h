// Tables of text: frames.csv and tracks_2d.csv.
#ifndef CERES_ED_APPS_EVAL_TABLE_FILE_H_
#define CERES_ED_APPS_EVAL_TABLE_FILE_H_

#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/evaluation/track_following.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// What frames.csv says, by columns.
struct FrameLog {
  std::vector<int> frames;
  std::vector<std::string> statuses;
  // All other columns in the order of the file: name and one value a frame, NaN where the file has
  // none.
  std::vector<std::pair<std::string, std::vector<double>>> columns;

  // The column of that name, or null.
  const std::vector<double>* Find(const std::string& name) const;
};

// Returns the log of a run: a header with at least `frame` and `status`, then a row a frame. Errors
// name file, line, value and what was expected.
StatusOr<FrameLog> ReadFrameLog(const std::string& path);

// A log in a few numbers.
struct LogSummary {
  std::map<std::string, int> frames_by_status;
  // Of frames that have an rms_plane and did not count 0 inliers; metres.
  AcrossFrames rms_plane;
  double rms_plane_last = 0.0;
  // Median of every column t_..., by its name; seconds.
  std::vector<std::pair<std::string, double>> median_times_s;
  // nodes, pr and map_points of the last row that has them.
  std::vector<std::pair<std::string, double>> at_the_end;
};

// Returns the sum of a log; parts whose columns are missing are empty or zero.
LogSummary SummarizeLog(const FrameLog& log);

// Returns the rows `frame,track,u,v` (pixels) of a file of picture tracks; text behind # and a
// header are ignored. Errors name file, line, value and what was expected.
StatusOr<std::vector<TrackObservation>> ReadPictureTracks(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_TABLE_FILE_H_
