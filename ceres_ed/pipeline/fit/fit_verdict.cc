#include "ceres_ed/pipeline/fit/fit_verdict.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace ceres_ed {
namespace {

// Bounds between good and doubtful, and between doubtful and bad. Shares of the surfaces:
constexpr VerdictBounds kUnmatchedSource = {0.1, 0.25};
constexpr VerdictBounds kUnmatchedTarget = {0.2, 0.4};
constexpr VerdictBounds kUnseen = {0.65, 0.9};
constexpr VerdictBounds kFolded = {0.001, 0.02};
// Logarithms of ratios of lengths. Bodies with limbs that bend stretch their edges by up to a third
// at the joints; a surface that is drawn onto another body stretches nearly everywhere.
constexpr VerdictBounds kEdgeStretch = {0.45, 0.9};
constexpr VerdictBounds kNodeStretch = {0.39, 0.75};
// Fractions of the diagonal.
constexpr VerdictBounds kDisagreement = {0.035, 0.1};
constexpr VerdictBounds kResidual = {0.004, 0.01};
constexpr VerdictBounds kSliding = {0.012, 0.05};
constexpr VerdictBounds kLandmarks = {0.02, 0.1};
// The noise as a part of the motion that it hides, where it is not negligible.
constexpr VerdictBounds kNoise = {0.25, 1.0};
constexpr double kNegligibleNoise = 0.001;
// The least curvature of the rigid objective; a body of which only this is wrong is never bad.
constexpr VerdictBounds kRigidCurvature = {0.002, -1.0};
// A surface with this relief lets the share (kRelief / relief)^2 of a motion slide along it, at
// most kMaxSliding of it.
constexpr double kRelief = 0.05;
constexpr double kMaxSliding = 0.7;
// Diagonals that differ by more than this factor may be in other units.
constexpr double kOtherUnit = 1.8;

std::string Percent(double share) {
  std::ostringstream text;
  text.precision(2);
  text << (share < 0.995 ? 100.0 * share : std::round(100.0 * share)) << " %";
  return text.str();
}

// Returns what to try where the surfaces do not cover each other.
std::string AdviceOnCover(const FitVerdictInput& input) {
  const double ratio = input.source_diagonal / std::max(input.target_diagonal, 1e-300);
  if (ratio > kOtherUnit || ratio < 1.0 / kOtherUnit) {
    return "are source and target in the same unit? try --scale=auto";
  }
  return "are these two states of one body? give --landmarks if they are";
}

// Returns the mean error that sliding along the surface may cause: the part of the motion that the
// shape of the surface does not determine. Where each of two flat surfaces goes on beyond the
// border of the other one, they lie beside each other by about that share of their length: one
// surface that shows less than the other would leave nothing on one side.
double SlidingEstimate(const FitEvidence& evidence) {
  if (evidence.relief < 0.0) return 0.0;
  const double ratio = kRelief / std::max(evidence.relief, 1e-6);
  const double beside = std::min(evidence.source.unseen, evidence.target.unseen);
  return std::max(evidence.bend * std::min(kMaxSliding, ratio * ratio),
                  beside * std::min(1.0, ratio * ratio));
}

void JudgeCover(const FitVerdictInput& input, Verdict* verdict) {
  const FitEvidence& evidence = input.result->evidence;
  const std::string advice = AdviceOnCover(input);
  verdict->Check(evidence.target.Unmatched(),
                 kUnmatchedTarget,
                 "target_unmatched",
                 Percent(evidence.target.Unmatched()) + " of the target is not covered",
                 advice);
  verdict->Check(evidence.source.Unmatched(),
                 kUnmatchedSource,
                 "source_unmatched",
                 Percent(evidence.source.Unmatched()) + " of the source does not lie on the target",
                 advice);
  verdict->Check(evidence.source.unseen,
                 kUnseen,
                 "source_unseen",
                 "the target shows only " + Percent(1.0 - evidence.source.unseen) +
                     " of the source; the rest follows by smoothness alone",
                 "use a target that shows more, or landmarks on the part that is hidden");
}

void JudgeShape(const FitVerdictInput& input, Verdict* verdict) {
  const FitEvidence& evidence = input.result->evidence;
  const std::string advice = AdviceOnCover(input);
  const auto stretched = [](double stretch) {
    std::ostringstream text;
    text.precision(3);
    text << "5 % of the lengths on the source change by more than a factor of "
         << std::exp(stretch);
    return text.str();
  };
  verdict->Check(
      evidence.node_stretch, kNodeStretch, "stretch", stretched(evidence.node_stretch), advice);
  verdict->Check(evidence.edge_stretch,
                 kEdgeStretch,
                 "edge_stretch",
                 stretched(evidence.edge_stretch) + " from vertex to vertex",
                 "use a larger --w_reg, or --finish=false if the target is rough");
  verdict->Check(evidence.folded,
                 kFolded,
                 "folds",
                 Percent(evidence.folded) + " of the faces are folded over",
                 "use a larger --w_reg or a larger --node_spacing");
}

void JudgeDetermination(const FitVerdictInput& input, Verdict* verdict) {
  const FitEvidence& evidence = input.result->evidence;
  const std::string landmarks = "give --landmarks for a few points that can be told for certain";
  verdict->Check(
      evidence.disagreement,
      kDisagreement,
      "starts_disagree",
      "a careful and a bold start end " + Percent(evidence.disagreement) + " of the diagonal apart",
      landmarks);
  const double sliding = SlidingEstimate(evidence);
  verdict->Check(sliding,
                 kSliding,
                 "sliding",
                 "the surface is so smooth that points may have slid along it, by about " +
                     Percent(sliding) + " of the diagonal",
                 landmarks);
  if (evidence.rigid_curvature >= 0.0) {
    verdict->Check(evidence.rigid_curvature,
                   kRigidCurvature,
                   "rigid_placement",
                   "the surfaces can turn or slide on each other at no cost, so that their shape "
                   "does not determine the rigid placement",
                   landmarks);
  }
}

void JudgeDistances(const FitVerdictInput& input, Verdict* verdict) {
  const FitEvidence& evidence = input.result->evidence;
  const double beyond = evidence.residual - evidence.noise;
  verdict->Check(beyond,
                 kResidual,
                 "residual",
                 "the matched parts are " + Percent(evidence.residual) +
                     " of the diagonal apart, more than the noise explains",
                 "use a smaller --node_spacing or a smaller --w_reg");
  if (evidence.noise > kNegligibleNoise) {
    verdict->Check(evidence.noise / std::max(evidence.bend, 1e-9),
                   kNoise,
                   "noise",
                   "the noise of the target (" + Percent(evidence.noise) +
                       " of the diagonal) hides much of the motion (" + Percent(evidence.bend) +
                       ')',
                   "use a target with less noise");
  }
}

void JudgeLandmarks(const FitVerdictInput& input, Verdict* verdict) {
  const double diagonal = input.source_diagonal * input.result->rigid.scale;
  const double error = input.landmark_rms / std::max(diagonal, 1e-300);
  verdict->Check(error,
                 kLandmarks,
                 "landmarks",
                 "the landmarks are " + Percent(error) + " of the diagonal off in the mean",
                 "check the landmarks, or use a larger --w_landmark");
}

}  // namespace

Verdict JudgeFit(const FitVerdictInput& input) {
  const FitResult& result = *input.result;
  Verdict verdict;
  if (!result.IsUsable()) {
    verdict.Add(Grade::kBad, {"failed", result.message, 0.0, 0.0}, "");
    return verdict;
  }
  if (result.evidence.measured) JudgeCover(input, &verdict);
  if (result.rigid_only) {
    verdict.Add(
        Grade::kDoubtful,
        {"rigid_only", "no deformation explains the target better than a rigid motion", 0.0, 0.0},
        AdviceOnCover(input));
  }
  if (result.evidence.measured) {
    JudgeShape(input, &verdict);
    JudgeDistances(input, &verdict);
    JudgeDetermination(input, &verdict);
  } else {
    verdict.Check(result.evidence.folded,
                  kFolded,
                  "folds",
                  Percent(result.evidence.folded) + " of the faces are folded over",
                  "check the landmarks, or use a larger --w_reg");
  }
  const int nodes = result.warp.graph.num_nodes();
  const int neighbors = result.warp.binding.neighbors;
  if (nodes <= neighbors) {
    verdict.Add(Grade::kDoubtful,
                {"few_nodes",
                 "the graph has so few nodes (" + std::to_string(nodes) +
                     ") that the whole body moves as one piece",
                 static_cast<double>(nodes),
                 static_cast<double>(neighbors + 1)},
                "use a smaller --node_spacing");
  }
  JudgeLandmarks(input, &verdict);
  if (result.status == SolveStatus::kTimeLimit || result.status == SolveStatus::kInterrupted) {
    verdict.Add(Grade::kDoubtful,
                {"stopped", "the fit was stopped before its end", 0.0, 0.0},
                "use a longer --time_limit_s");
  }
  return verdict;
}

}  // namespace ceres_ed
