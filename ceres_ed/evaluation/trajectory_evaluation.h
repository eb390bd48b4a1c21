// Measures the difference between an estimated camera trajectory and the true one.
//
// In a scene that deforms, the motion of the camera and a rigid part of the motion of the tissue
// look the same to the camera, and one can replace the other: a map may follow the tissue well in
// every camera frame and still have a large camera error. Judge such a run first by its surface and
// tracking errors.
#ifndef CERES_ED_EVALUATION_TRAJECTORY_EVALUATION_H_
#define CERES_ED_EVALUATION_TRAJECTORY_EVALUATION_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <vector>

namespace ceres_ed {

// The error of one frame after an alignment.
struct PoseError {
  int frame = 0;
  // The distance between the camera centres, in metres.
  double translation = 0.0;
  // The angle of the rotation between the two orientations, in degrees.
  double rotation_deg = 0.0;
};

// The errors of all frames after one alignment.
struct TrajectoryError {
  std::vector<PoseError> frames;
  // Root mean square, mean, median and maximum over the frames; metres and degrees.
  double translation_rmse = 0.0;
  double translation_mean = 0.0;
  double translation_median = 0.0;
  double translation_max = 0.0;
  double rotation_mean_deg = 0.0;
  double rotation_max_deg = 0.0;
};

// The errors of a trajectory after two alignments.
struct TrajectoryEvaluation {
  // The estimate is aligned with the truth at the first frame that both contain; the error is the
  // drift since then.
  TrajectoryError from_first_frame;
  // The estimate is aligned with the truth by the rigid motion that is best for the camera centres
  // (absolute trajectory error). If the centres lie on one line, or are fewer than three, they do
  // not determine it; then the rotation is the mean of the rotations between the two, and the
  // translation is that between the mean centres.
  TrajectoryError best_alignment;
};

// Returns the errors over the frames that both trajectories contain. They map frames to
// world_from_camera in metres; their worlds may differ by a rigid motion. It is an error if there
// is no common frame.
StatusOr<TrajectoryEvaluation> EvaluateTrajectory(const std::map<int, CameraPose>& estimate,
                                                  const std::map<int, CameraPose>& truth);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_TRAJECTORY_EVALUATION_H_
