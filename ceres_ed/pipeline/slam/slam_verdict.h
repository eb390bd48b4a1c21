// The verdict on a run of tracking, from what can be seen without truth.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_VERDICT_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_VERDICT_H_

#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/pipeline/verdict.h>

#include <vector>

namespace ceres_ed {

// Judges the frames of a run. `node_spacing` is in metres.
Verdict JudgeRun(const std::vector<FrameRecord>& records, double node_spacing);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_VERDICT_H_
