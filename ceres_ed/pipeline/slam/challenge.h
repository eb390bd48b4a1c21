// The files of the challenges STIR and SurgT, which score how given points of the tissue are
// tracked.
#ifndef CERES_ED_PIPELINE_SLAM_CHALLENGE_H_
#define CERES_ED_PIPELINE_SLAM_CHALLENGE_H_

#include <ceres_ed/io/sequence/layouts/surgt_truth.h>
#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/pipeline/slam/warning_log.h>
#include <ceres_ed/slam/tracked_points.h>
#include <ceres_ed/stereo/depth_source.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The points that a challenge gives in the first frame of a run, and what is written about them:
//
//   stir   stir_2d.json      {clip: [[u, v], ...]} in the last frame, pixels
//          stir_3d.json      {clip: [[x, y, z], ...]} in the last frame, millimetres, left camera
//          stir_tracks.json  for each point and frame pixel, position in millimetres, visible
//   surgt  pred_rectified_N.yaml for each gt_rectified_N.yaml: its form, with the tracked boxes
//
// Clips are named by their folder left*/seqNN. A point without depth follows the nearest one that
// has depth. The pixels of SurgT are those of pictures that OpenCV rectifies with alpha = 0.
class ChallengePoints {
 public:
  // Reads the annotation of the sequence in settings.input, and the first frame that can be read.
  // It is an error if there is no annotation, or no point of it has depth. With kNone there are no
  // points.
  static StatusOr<ChallengePoints> Load(const SlamSettings& settings,
                                        const DepthSource& source,
                                        WarningLog* warnings);

  // The points to follow, with their numbers as ids.
  const std::vector<NamedPoint>& points() const { return points_; }

  // Writes the files into the folder of the result, from its tracks.csv.
  Status Write(const std::string& folder, const DepthSource& source) const;

 private:
  Status WriteStir(const std::string& folder, const DepthSource& source) const;
  Status WriteSurgT(const std::string& folder, const DepthSource& source) const;

  Challenge challenge_ = Challenge::kNone;
  // The name of the clip.
  std::string name_;
  // The pixel of each point in the first frame, in the camera of the depth.
  std::vector<Eigen::Vector2d> pixels_;
  std::vector<NamedPoint> points_;
  // With SurgT: the boxes, one for each point.
  std::vector<BoxTrack> boxes_;
  int first_frame_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_CHALLENGE_H_
