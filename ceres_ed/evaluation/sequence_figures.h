// All measurements of a sequence, and the figures that summarise them.
#ifndef CERES_ED_EVALUATION_SEQUENCE_FIGURES_H_
#define CERES_ED_EVALUATION_SEQUENCE_FIGURES_H_

#include <ceres_ed/evaluation/scan_truth.h>
#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/evaluation/track_following.h>
#include <ceres_ed/evaluation/trajectory_evaluation.h>
#include <ceres_ed/io/results/frames_csv.h>

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// How far points of the first frame are, in the last one, from the nearest points that are given
// there (STIR). Which of these belongs to which is not known.
struct EndPointError {
  // The number of points of the first frame, and of those that could be followed to the last one.
  int points = 0;
  int followed = 0;
  // In pixels; nothing if no point was followed.
  std::optional<DistanceStatistics> error;
  // The shares of the followed points within kEndPointBounds.
  std::array<double, 5> within{};
};
// In pixels, as the challenge has them.
inline constexpr std::array<double, 5> kEndPointBounds = {4.0, 8.0, 16.0, 32.0, 64.0};

// Returns the errors of the points that were followed, of `points_at_start` ones. `given` has at
// least one point.
EndPointError CompareEndPoints(int points_at_start,
                               const std::vector<Eigen::Vector2d>& predicted,
                               const std::vector<Eigen::Vector2d>& given);

// All measurements of a sequence. Parts that could not be measured are empty.
struct SequenceFigures {
  std::vector<FrameTruthError> truth;
  std::optional<TrajectoryEvaluation> camera;
  std::vector<DepthAgreement> depth;
  std::optional<TrackEvaluation> tracks;
  std::optional<EndPointError> end_points;
  std::vector<ScanAgreement> scans;
  std::optional<FrameLog> log;
};

// A set of distances in a frame with truth. Reports contain all sets for every frame. A new set
// needs a member of FrameTruthError, its computation in TruthEvaluator, and a row here.
struct TruthSet {
  const char* name;
  std::optional<DistanceStatistics> FrameTruthError::*set;
};
inline constexpr TruthSet kTruthSets[] = {{"surface_all", &FrameTruthError::surface_all},
                                          {"surface_seen", &FrameTruthError::surface_seen},
                                          {"tracking_seen", &FrameTruthError::tracking_seen},
                                          {"tracking_hidden", &FrameTruthError::tracking_hidden}};

// A figure of a set, which is summarised over the frames.
struct TruthFigure {
  const char* name;
  std::optional<DistanceStatistics> FrameTruthError::*set;
  double DistanceStatistics::*statistic;

  // Returns the figure of a frame, or nothing if the frame has no such distances.
  std::optional<double> Of(const FrameTruthError& error) const {
    if (!(error.*set)) return std::nullopt;
    return *(error.*set).*statistic;
  }
};
inline constexpr TruthFigure kTruthFigures[] = {
    {"surface_all_median", &FrameTruthError::surface_all, &DistanceStatistics::p50},
    {"surface_seen_median", &FrameTruthError::surface_seen, &DistanceStatistics::p50},
    {"surface_seen_mean", &FrameTruthError::surface_seen, &DistanceStatistics::mean},
    {"surface_seen_p95", &FrameTruthError::surface_seen, &DistanceStatistics::p95},
    {"tracking_seen_mean", &FrameTruthError::tracking_seen, &DistanceStatistics::mean},
    {"tracking_seen_median", &FrameTruthError::tracking_seen, &DistanceStatistics::p50},
    {"tracking_hidden_mean", &FrameTruthError::tracking_hidden, &DistanceStatistics::mean},
    {"tracking_hidden_median", &FrameTruthError::tracking_hidden, &DistanceStatistics::p50}};

// Returns the summary of a figure over the frames.
AcrossFrames SummarizeTruth(const std::vector<FrameTruthError>& frames, const TruthFigure& figure);

// Returns the summary, over the frames, of the median or the 95th percentile of the depth residuals
// of each frame.
AcrossFrames SummarizeDepth(const std::vector<DepthAgreement>& frames,
                            double DistanceStatistics::*statistic);
// Returns the summary, over the frames, of the share of points that are far from the depth.
AcrossFrames SummarizeFarShare(const std::vector<DepthAgreement>& frames);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_SEQUENCE_FIGURES_H_
