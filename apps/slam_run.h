// The course of ed_slam: open, then read, track and write frame by frame, then tell.
#ifndef CERES_ED_APPS_SLAM_RUN_H_
#define CERES_ED_APPS_SLAM_RUN_H_

#include <string>
#include <vector>

#include <apps/support/program.h>

namespace ceres_ed {

// Returns how the run ended. `arguments` is SEQUENCE_DIR; everything else comes from the flags.
Outcome RunSlam(const std::vector<std::string>& arguments);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_RUN_H_
