// How good a map is, frame by frame: against the true tissue, and against the depth images.
//
// Everything is compared in the camera frame of each frame, so that no choice of a map frame and no
// alignment enters.
#ifndef CERES_ED_EVALUATION_SEQUENCE_EVALUATION_H_
#define CERES_ED_EVALUATION_SEQUENCE_EVALUATION_H_

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/true_surface.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/util/status.h>

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace ceres_ed {

// Bounds are shares of a point's own depth, so that they mean the same in any unit.
struct SequenceEvaluationOptions {
  // A map point born farther than this from the true surface sat on no tissue point: its tracking
  // error is unknown, its surface error counts all the same. 2 mm at a depth of 0.29 m.
  double max_birth_offset = 0.007;
  // A point is hidden when it lies farther than this behind what the camera sees at its pixel. Wide
  // enough for the error of a map, narrower than an organ: 8 mm at 0.27 m.
  double visibility_tolerance = 0.03;

  // False, with the value and what was expected in `error`, unless all are positive.
  bool IsValid(std::string* error) const;
};

// Errors of one frame, metres; statistics are nothing where there is no such point.
struct FrameTruthError {
  int frame = 0;
  int points = 0;
  // In the picture and not behind the true surface, by its z-buffer.
  int seen = 0;
  // Points that sat on no tissue point at birth, or too far from it to tell.
  int unknown = 0;
  // Exact distance of the map points to the triangles of the true surface.
  std::optional<DistanceStatistics> surface_all;
  std::optional<DistanceStatistics> surface_seen;
  // Distance of the map points to where the tissue point is that they sat on at birth.
  std::optional<DistanceStatistics> tracking_seen;
  std::optional<DistanceStatistics> tracking_hidden;
};

// Compares snapshots with the truth. Remembers the tissue point of each id: it never changes.
class TruthEvaluator {
 public:
  // `truth` is kept by reference and must outlive this. CHECKs the options.
  TruthEvaluator(const PinholeCamera& camera,
                 const SceneTruth& truth,
                 const SequenceEvaluationOptions& options = {});

  // Returns the errors of a snapshot. Errors name the frame or the id: the truth lacks the frame, a
  // point was born in a later frame than this or in one that the truth lacks, or in another one
  // than an earlier snapshot said.
  StatusOr<FrameTruthError> Evaluate(const LiveSnapshot& snapshot);

 private:
  struct Birth {
    int frame = 0;
    TissuePoint tissue;
  };

  Status LocateNewPoints(const LiveSnapshot& snapshot, const TrueSurface& surface);

  PinholeCamera camera_;
  const SceneTruth& truth_;
  SequenceEvaluationOptions options_;
  std::unordered_map<int, Birth> births_;
};

// How the map agrees with the depth image of its frame.
struct DepthAgreement {
  int frame = 0;
  int points = 0;
  // In the picture and behind no other map point.
  int seen = 0;
  // Of those at a pixel that has a depth.
  int measured = 0;
  // |z - depth| at the pixel, along the optical axis, metres; nothing where none is measured.
  std::optional<DistanceStatistics> residual;
};

// Returns how `snapshot` agrees with `depth`. CHECKs that the image has the camera's size.
DepthAgreement CompareWithDepth(const PinholeCamera& camera,
                                const LiveSnapshot& snapshot,
                                const DepthImage& depth,
                                const SequenceEvaluationOptions& options = {});

// One figure of every frame, in sum.
struct AcrossFrames {
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
  // How many frames have it.
  int frames = 0;
};

// Returns the sum of a figure; frames that lack it do not count. All zero where all lack it.
AcrossFrames SummarizeFrames(const std::vector<std::optional<double>>& values);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_SEQUENCE_EVALUATION_H_
