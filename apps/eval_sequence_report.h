// What ed_eval says of a sequence.
#ifndef CERES_ED_APPS_EVAL_SEQUENCE_REPORT_H_
#define CERES_ED_APPS_EVAL_SEQUENCE_REPORT_H_

#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/evaluation/track_following.h>
#include <ceres_ed/evaluation/trajectory_evaluation.h>

#include <optional>
#include <string>
#include <vector>

#include <apps/eval_table_file.h>
#include <nlohmann/json.hpp>

namespace ceres_ed {

// Everything that was measured; what could not be is empty.
struct SequenceFigures {
  std::vector<FrameTruthError> truth;
  std::optional<TrajectoryEvaluation> camera;
  std::vector<DepthAgreement> depth;
  std::optional<TrackEvaluation> tracks;
  std::optional<FrameLog> log;
};

// A figure that each frame has, such as "surface_seen_median".
struct FrameFigure {
  const char* name;
  std::optional<double> (*of)(const FrameTruthError& error);
};

// Returns the figures of a frame with truth that are summed over the frames.
const std::vector<FrameFigure>& TruthFigures();

// Returns one of them over the frames.
AcrossFrames SummarizeTruth(const std::vector<FrameTruthError>& frames, const FrameFigure& figure);

// Returns the median or the 95th percentile of the depth residuals of each frame over the frames.
AcrossFrames SummarizeDepth(const std::vector<DepthAgreement>& frames,
                            double DistanceStatistics::*figure);

// Returns tables for people, in millimetres, pixels and degrees: every part that there is, a dozen
// frames, and the sum over all of them.
std::string SequenceTables(const SequenceFigures& figures);

// Returns {"truth", "camera", "depth", "tracks_2d", "log"} for programs, in metres, pixels, degrees
// and seconds, each null where it could not be had: a "summary" over the frames (mean and median of
// each figure of a frame) and all "frames".
nlohmann::ordered_json SequenceReport(const SequenceFigures& figures);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_SEQUENCE_REPORT_H_
