// Tracks a sequence on disk: opens it, and then reads, tracks and writes frame by frame.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_RUN_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_RUN_H_

#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/slam/slam_observer.h>
#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/util/timer.h>

namespace ceres_ed {

// Tracks the sequence and returns how the run ended. `clock` must have been started with the
// program: the time limit and the reported times are counted from there. These are usage errors: an
// energy is unknown; --resume is given with other flags than before; the output folder is the input
// folder; it has a result, and neither `resume` nor `overwrite` is set.
Outcome RunSlam(const SlamSettings& settings, const Timer& clock, SlamObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_RUN_H_
