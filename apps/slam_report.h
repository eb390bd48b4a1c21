// What ed_slam says of a run: report.json for programs, a summary and a line a frame for people.
#ifndef CERES_ED_APPS_SLAM_REPORT_H_
#define CERES_ED_APPS_SLAM_REPORT_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/slam/slam.h>

#include <string>
#include <vector>

#include <apps/slam_flags.h>
#include <apps/slam_frames.h>
#include <nlohmann/json.hpp>

namespace ceres_ed {

// A run as far as it has come. None of the pointers is null.
struct SlamRun {
  const SlamSettings* settings = nullptr;
  std::string sequence_path;
  const DepthSequence* sequence = nullptr;
  const DeformableSlam* slam = nullptr;
  const std::vector<FrameRecord>* records = nullptr;
  const std::vector<std::string>* warnings = nullptr;
  // "running" (a checkpoint), "done", "time_limit", "interrupted" or "failed".
  std::string status;
  std::string message;
  // Since the start of the program, and of all parts of a run that was resumed.
  double total_s = 0.0;
};

// Returns the contents of report.json; lengths are in metres, times in seconds.
nlohmann::ordered_json SlamReport(const SlamRun& run);

// Returns a few aligned lines on how the run went.
std::string SlamSummary(const SlamRun& run);

// Returns a frame as one line of JSON, with the names of frames.csv; `done` of `total` are behind
// us.
std::string ProgressJson(const FrameRecord& record, int done, int total, double frames_per_s);

// Returns a few words on a frame for the progress bar.
std::string ProgressNote(const FrameRecord& record, double frames_per_s);

// Returns how many frames ended like this.
int CountFrames(const std::vector<FrameRecord>& records, FrameStatus status);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_REPORT_H_
