// Measures the reprojection error of a map against tracks of image points.
#ifndef CERES_ED_EVALUATION_TRACK_FOLLOWING_H_
#define CERES_ED_EVALUATION_TRACK_FOLLOWING_H_

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/sequence/picture_tracks.h>

#include <cstddef>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Options of TrackFollower.
struct TrackFollowingOptions {
  // The largest number of map points to which a track is attached, >= 1; default 4.
  int neighbors = 4;
  // The largest distance of these map points from the track in the picture, in pixels, > 0; default
  // 8.
  double max_distance = 8.0;
  // Tracks that move farther than this from their start in the picture are also counted apart;
  // pixels, > 0, default 50.
  double moved_distance = 50.0;
  // The options of the visibility of map points.
  SequenceEvaluationOptions visibility;
};

// The errors of the tracks in one frame, in pixels.
struct TrackFrameError {
  int frame = 0;
  // The number of tracks that are given in this frame and were attached to the map in an earlier
  // one.
  int tracks = 0;
  // The number of these tracks whose map points are all removed or behind the camera.
  int lost = 0;
  std::optional<DistanceStatistics> error;
};

// The errors of all tracks.
struct TrackEvaluation {
  // The number of tracks that are given in a frame of the result.
  int tracks = 0;
  // The number of these tracks that could be attached to the map.
  int followed = 0;
  // The number of followed tracks that had no map point near them in their first frame, but in a
  // later one.
  int late = 0;
  // The number of followed tracks that lost all their map points in at least one frame.
  int lost = 0;
  // The errors over all tracks and frames, in pixels. The frame in which a track was attached is
  // left out, because the error is zero there. Nothing if no track was followed into another frame.
  std::optional<DistanceStatistics> error;
  // The number of followed tracks that move far (moved_distance), and their errors in the last
  // frames in which they are given: those of tissue that was pulled away.
  int moved = 0;
  std::optional<DistanceStatistics> moved_error;
  std::vector<TrackFrameError> frames;
};

// Follows tracks through the snapshots. In the first frame in which a track is given and has map
// points near it, it is attached to the nearest visible ones. From then on its predicted motion is
// the mean of their displacements in the picture, weighted by the inverse of their distances.
class TrackFollower {
 public:
  TrackFollower(const PinholeCamera& camera,
                const std::vector<TrackObservation>& observations,
                const TrackFollowingOptions& options = {});

  // Adds a snapshot. Snapshots must come in ascending order of their frames.
  void Add(const LiveSnapshot& snapshot);

  // Returns the errors so far.
  TrackEvaluation Evaluate() const;

  // Returns where the tracks are that are attached to the map, in the picture of a snapshot that
  // was made later. Tracks that have lost all their map points are left out.
  std::vector<Eigen::Vector2d> Predict(const LiveSnapshot& snapshot) const;

 private:
  struct Tie {
    int id = -1;
    double weight = 0.0;
    // The position of the map point when the track was attached.
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  };
  struct Track {
    bool given = false;
    bool late = false;
    bool lost = false;
    Eigen::Vector2d start = Eigen::Vector2d::Zero();
    // The farthest that the given track is from its start, and its last error.
    double motion = 0.0;
    std::optional<double> last_error;
    std::vector<Tie> ties;
  };
  // A visible map point.
  struct Candidate {
    int id;
    Eigen::Vector2d pixel;
  };

  // Returns the predicted pixel of a track; nothing if all its map points are removed or behind the
  // camera. `index_of_id` has the place of each map point in the snapshot.
  std::optional<Eigen::Vector2d> PredictTrack(
      const Track& track,
      const LiveSnapshot& snapshot,
      const std::unordered_map<int, std::size_t>& index_of_id) const;
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
