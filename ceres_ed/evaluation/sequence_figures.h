// All measurements of a sequence, and the figures that summarise them.
#ifndef CERES_ED_EVALUATION_SEQUENCE_FIGURES_H_
#define CERES_ED_EVALUATION_SEQUENCE_FIGURES_H_

#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/evaluation/track_following.h>
#include <ceres_ed/evaluation/trajectory_evaluation.h>
#include <ceres_ed/io/results/frames_csv.h>

#include <optional>
#include <vector>

namespace ceres_ed {

// All measurements of a sequence. Parts that could not be measured are empty.
struct SequenceFigures {
  std::vector<FrameTruthError> truth;
  std::optional<TrajectoryEvaluation> camera;
  std::vector<DepthAgreement> depth;
  std::optional<TrackEvaluation> tracks;
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

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_SEQUENCE_FIGURES_H_
