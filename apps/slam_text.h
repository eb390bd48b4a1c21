// What ed_slam prints: a summary, and a line for each frame.
#ifndef CERES_ED_APPS_SLAM_TEXT_H_
#define CERES_ED_APPS_SLAM_TEXT_H_

#include <ceres_ed/pipeline/slam/slam_observer.h>

#include <string>

namespace ceres_ed {

// Returns a few aligned lines on how the run went.
std::string SlamSummary(const SlamRun& run);

// Returns a frame as one line of JSON, with the names of frames.csv; `done` of `total` are behind
// us.
std::string ProgressJson(const FrameRecord& record, int done, int total, double frames_per_s);

// Returns a few words on a frame for the progress bar.
std::string ProgressNote(const FrameRecord& record, double frames_per_s);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_TEXT_H_
