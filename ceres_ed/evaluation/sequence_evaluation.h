// Measures how good a map is, frame by frame, against the true tissue and against the depth images.
//
// All comparisons are made in the camera frame of each frame, so that neither the choice of a map
// frame nor an alignment affects them.
#ifndef CERES_ED_EVALUATION_SEQUENCE_EVALUATION_H_
#define CERES_ED_EVALUATION_SEQUENCE_EVALUATION_H_

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/true_surface.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace ceres_ed {

// Options of the evaluation. Lengths are shares of a point's own depth, so that they do not depend
// on the unit, unless they are in metres.
struct SequenceEvaluationOptions {
  // A map point that was farther than this from the true surface when it was created belongs to no
  // tissue point: its tracking error is unknown, but its surface error counts. > 0; default 0.007,
  // which is 2 mm at a depth of 0.29 m.
  double max_birth_offset = 0.007;
  // A point is hidden if it lies farther than this behind what the camera sees at its pixel. The
  // value is larger than the error of a map and smaller than an organ. > 0; default 0.03, which is
  // 8 mm at 0.27 m.
  double visibility_tolerance = 0.03;
  // A point that is farther than this from the depth at its pixel is far from it. In metres, > 0;
  // default 0.003.
  double far_residual = 0.003;

  // Returns false, with the value and what was expected in `error`, unless all values are positive.
  bool IsValid(std::string* error) const;
};

// The errors of one frame in metres. A statistic is nothing if there are no such points.
struct FrameTruthError {
  int frame = 0;
  int points = 0;
  // The number of points in the picture that are not behind the true surface, by its z-buffer.
  int seen = 0;
  // The number of points without a tissue point, because they were too far from the true surface
  // when they were created.
  int unknown = 0;
  // The exact distance of the map points to the triangles of the true surface.
  std::optional<DistanceStatistics> surface_all;
  std::optional<DistanceStatistics> surface_seen;
  // The distance of each map point to the present position of the tissue point at which it was
  // created.
  std::optional<DistanceStatistics> tracking_seen;
  std::optional<DistanceStatistics> tracking_hidden;
};

// Compares snapshots with the truth. It keeps the tissue point of each identifier, which never
// changes.
class TruthEvaluator {
 public:
  // `truth` is kept by reference and must outlive this object. CHECKs the options.
  TruthEvaluator(const PinholeCamera& camera,
                 const SceneTruth& truth,
                 const SequenceEvaluationOptions& options = {});

  // Returns the errors of a snapshot. It is an error, with the frame or the identifier, if the
  // truth lacks the frame, or if a point was created in a later frame, in a frame that the truth
  // lacks, or in a frame other than the one in an earlier snapshot.
  StatusOr<FrameTruthError> Evaluate(const LiveSnapshot& snapshot);

  // Returns for each point of a snapshot the distance to the present position of its tissue point,
  // in metres, NaN if it has none. Errors are as above.
  StatusOr<std::vector<double>> TrackingErrors(const LiveSnapshot& snapshot);

 private:
  struct Birth {
    int frame = 0;
    TissuePoint tissue;
  };

  // Returns an error unless the truth has the frame of a snapshot.
  Status CheckFrame(const LiveSnapshot& snapshot) const;
  // Returns the distance of a point from its tissue point; NaN if it has none.
  double TrackingError(const LiveSnapshot& snapshot,
                       std::size_t point,
                       const TrueSurface& surface) const;
  Status LocateNewPoints(const LiveSnapshot& snapshot, const TrueSurface& surface);

  PinholeCamera camera_;
  const SceneTruth& truth_;
  SequenceEvaluationOptions options_;
  std::unordered_map<int, Birth> births_;
};

// How well the map agrees with the depth image of its frame.
struct DepthAgreement {
  int frame = 0;
  int points = 0;
  // The number of points that are in the picture and not behind another map point.
  int seen = 0;
  // The number of these points whose pixel has a depth.
  int measured = 0;
  // |z - depth| at the pixel, along the optical axis, in metres; nothing if no point is measured.
  std::optional<DistanceStatistics> residual;
  // The share of the measured points whose residual is more than `far_residual` of the options;
  // nothing if no point is measured.
  std::optional<double> far_share;
};

// Returns how well `snapshot` agrees with `depth`. CHECKs that the image has the camera's size.
DepthAgreement CompareWithDepth(const PinholeCamera& camera,
                                const LiveSnapshot& snapshot,
                                const DepthImage& depth,
                                const SequenceEvaluationOptions& options = {});

// A summary of one measure over all frames.
struct AcrossFrames {
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
  // The number of frames that have the measure.
  int frames = 0;
};

// Returns the summary of a measure. Frames without it do not count; all values are zero if no frame
// has it.
AcrossFrames SummarizeFrames(const std::vector<std::optional<double>>& values);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_SEQUENCE_EVALUATION_H_
