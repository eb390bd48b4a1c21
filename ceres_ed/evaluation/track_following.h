// Reprojection error of a map against tracks of picture points.
#ifndef CERES_ED_EVALUATION_TRACK_FOLLOWING_H_
#define CERES_ED_EVALUATION_TRACK_FOLLOWING_H_

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/sequence/picture_tracks.h>

#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

struct TrackFollowingOptions {
  // A track is tied to so many map points...
  int neighbors = 4;
  // ...that are seen at most this far from it in the picture, pixels.
  double max_distance = 8.0;
  // Of the map's visibility.
  SequenceEvaluationOptions visibility;
};

// Errors of the tracks in one frame, pixels.
struct TrackFrameError {
  int frame = 0;
  // Tracks that are given here and were tied to the map before.
  int tracks = 0;
  // Of those whose map points are all gone, or behind the camera.
  int lost = 0;
  std::optional<DistanceStatistics> error;
};

struct TrackEvaluation {
  // Tracks that are given in a frame of the result.
  int tracks = 0;
  // Of those that could be tied to the map.
  int followed = 0;
  // Of those followed that had no map point near them in their first frame, but in a later one.
  int late = 0;
  // Of those followed that lost all their map points in a frame at least.
  int lost = 0;
  // Over all tracks and frames, the frame in which each was tied to the map left out: its error is
  // zero there. Pixels; nothing where no track was followed into another frame.
  std::optional<DistanceStatistics> error;
  std::vector<TrackFrameError> frames;
};

// Follows tracks through the snapshots. In the first frame in which it is given and map points are
// near, a track is tied to the nearest ones that are seen; from then on it is carried by the mean
// of their displacements in the picture, each weighted by the inverse of its distance.
class TrackFollower {
 public:
  TrackFollower(const PinholeCamera& camera,
                const std::vector<TrackObservation>& observations,
                const TrackFollowingOptions& options = {});

  // Snapshots come in ascending order of their frames.
  void Add(const LiveSnapshot& snapshot);

  // Returns the errors so far.
  TrackEvaluation Evaluate() const;

 private:
  struct Tie {
    int id = -1;
    double weight = 0.0;
    // Of the map point when it was tied.
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  };
  struct Track {
    bool given = false;
    bool late = false;
    bool lost = false;
    Eigen::Vector2d start = Eigen::Vector2d::Zero();
    std::vector<Tie> ties;
  };
  // A map point that is seen.
  struct Candidate {
    int id;
    Eigen::Vector2d pixel;
  };

  std::vector<Candidate> SeenPoints(const LiveSnapshot& snapshot) const;
  void TieTo(const std::vector<Candidate>& candidates,
             const Eigen::Vector2d& pixel,
             Track* track) const;

  PinholeCamera camera_;
  TrackFollowingOptions options_;
  std::map<int, std::vector<TrackObservation>> observations_of_frame_;
  std::map<int, Track> tracks_;
  std::vector<TrackFrameError> frames_;
  std::vector<double> errors_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_TRACK_FOLLOWING_H_
