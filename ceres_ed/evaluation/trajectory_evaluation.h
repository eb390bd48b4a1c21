// How far an estimated camera is from the true one.
//
// In a scene that deforms, the motion of the camera and a rigid part of the motion of the tissue
// look the same to the camera and trade against one another: a map may follow the tissue well in
// every camera frame and still have a large camera error. Judge such a run by surface and tracking
// error first.
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
  // Between the camera centres, metres.
  double translation = 0.0;
  // Angle of the rotation between the two orientations, degrees.
  double rotation_deg = 0.0;
};

struct TrajectoryError {
  std::vector<PoseError> frames;
  // Root mean square, mean, median and maximum over the frames.
  double translation_rmse = 0.0;
  double translation_mean = 0.0;
  double translation_median = 0.0;
  double translation_max = 0.0;
  double rotation_mean_deg = 0.0;
  double rotation_max_deg = 0.0;
};

struct TrajectoryEvaluation {
  // The estimate laid on the truth at the first frame that both have: drift since then.
  TrajectoryError from_first_frame;
  // Laid on the truth by the rigid motion that is best for the camera centres (absolute trajectory
  // error). Centres on one line, or fewer than three, leave it undetermined: then it is the mean of
  // the rotations between the two, and the translation between the mean centres.
  TrajectoryError best_alignment;
};

// Returns the errors over the frames that are in both (frame to world_from_camera, metres; the
// worlds may differ by a rigid motion). Error: there is no such frame.
StatusOr<TrajectoryEvaluation> EvaluateTrajectory(const std::map<int, CameraPose>& estimate,
                                                  const std::map<int, CameraPose>& truth);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_TRAJECTORY_EVALUATION_H_
