// The page and the picture of a run of tracking.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_LOOK_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_LOOK_H_

#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/util/status.h>

namespace ceres_ed {

// Returns an error if a page or a picture is requested that can not be written.
Status PrepareSlamLook(const SlamSettings& settings);

// Writes the page and the picture that the settings request, from the files that the run has
// written. The truth of the sequence is not read: ed_report and ed_eval show errors.
Status WriteSlamLook(const SlamSettings& settings);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_LOOK_H_
