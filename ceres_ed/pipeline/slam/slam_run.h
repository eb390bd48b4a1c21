// Tracking of a sequence on disk: open it, then read, track and write frame by frame.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_RUN_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_RUN_H_

#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/slam/slam_observer.h>
#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/util/timer.h>

namespace ceres_ed {

// Returns how the run ended. `clock` runs since the start of the program; time limits and reports
// count from there. A usage: energies that are unknown, --resume with other flags than before, an
// output folder that is the input, or that holds a result which neither `resume` nor `overwrite`
// gives up.
Outcome RunSlam(const SlamSettings& settings, const Timer& clock, SlamObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_RUN_H_
