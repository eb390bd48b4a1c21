// The texts that ed_slam prints: a summary, and a line for each frame.
#ifndef CERES_ED_APPS_SLAM_TEXT_H_
#define CERES_ED_APPS_SLAM_TEXT_H_

#include <ceres_ed/pipeline/slam/slam_observer.h>

#include <string>

namespace ceres_ed {

// Returns a summary of the run in a few aligned lines.
std::string SlamSummary(const SlamRun& run);

// Returns a frame as one line of JSON with the names of frames.csv. `done` of `total` frames are
// finished.
std::string ProgressJson(const FrameRecord& record, int done, int total, double frames_per_s);

// Returns a few words about a frame for the progress bar.
std::string ProgressNote(const FrameRecord& record, double frames_per_s);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_TEXT_H_
