#include "ceres_ed/registration/hypotheses/portfolio.h"

#include <ceres_ed/registration/evidence/way_agreement.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/hypotheses/explanation.h>
#include <ceres_ed/registration/intrinsic/intrinsic_start.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <utility>

namespace ceres_ed {
namespace {

// The distance at which a point counts half as unmatched, as a fraction of the source's diagonal: a
// coarse graph cannot follow details.
constexpr double kUnmatchedWidth = 0.02;
// Noise leaves residuals of this many standard deviations.
constexpr double kResidualPerNoise = 2.0;
// So many attempts are followed on the finest graph if they are this near to the best one, and if
// that one leaves more than a small share unmatched.
constexpr std::size_t kFinalists = 2;
constexpr double kFinalistMargin = 0.1;
// Nodes that two warps move to places this near in the mean make the two the same.
constexpr double kSameWarp = 0.01;
// A coarse graph leaves this share unmatched at most where it has followed all of the smaller
// surface; this is worth so much beyond the share itself, and there are no other finalists.
constexpr double kExplained = 0.03;
constexpr double kExplainedBonus = 0.02;
// If more than this share of the other surface is unmatched, one shows only a part of the other.
constexpr double kPartial = 0.2;
// An attempt falls behind if, in one of so many steps before the last one, it is not to be expected
// any more that it reaches the best one: a step gains at most about these shares.
constexpr int kForeseenSteps = 2;
constexpr double kGainAtLeast = 0.05;
constexpr double kGainPerStep = 0.05;

// Returns the mean distance between the places to which two states move the nodes.
double MeanDistance(const DeformationState& a, const DeformationState& b) {
  double sum = 0.0;
  for (int j = 0; j < a.num_nodes(); ++j) {
    sum += (NodeTranslation(a.node(j)) - NodeTranslation(b.node(j))).norm();
  }
  return a.num_nodes() > 0 ? sum / a.num_nodes() : 0.0;
}

}  // namespace

std::vector<DeformationState> Portfolio::StartsOf(const Hypothesis& hypothesis) const {
  if (hypothesis.start == HypothesisStart::kIntrinsic) return IntrinsicStarts(fit_, graphs_[0]);
  return {StartOf(hypothesis, fit_, graphs_[0])};
}

Status Portfolio::Follow(double best, Attempt* attempt, FitResult* result) const {
  for (int resolution = 0; resolution < graphs_.finest(); ++resolution) {
    if (resolution > 0) {
      attempt->state = graphs_.CarryOver(attempt->state, resolution - 1, resolution);
    }
    attempt->graph = resolution;
    ResolutionPlan plan = attempt->hypothesis.Apply(plans_[resolution], /*is_finest=*/false);
    plan.progress_begin *= attempt->progress;
    plan.progress_end *= attempt->progress;
    plan.unmatched_width = kUnmatchedWidth;
    bool has_fallen_behind = false;
    const int steps = plan.steps;
    plan.keep_going = [&](int step, const Unmatched& unmatched) {
      const int remaining = steps - 1 - step;
      const double gain = kGainAtLeast + kGainPerStep * remaining;
      has_fallen_behind = remaining <= kForeseenSteps && MeanAmongWays(unmatched) - gain > best;
      return !has_fallen_behind;
    };
    const auto problem = FitProblem::Create(fit_, graphs_[resolution], plan.is_last);
    if (!problem.ok()) return problem.status();
    RunNonrigidLoop(fit_, graphs_[resolution], plan, problem->get(), &attempt->state, result);
    if (result->EndedEarly()) break;
    if (has_fallen_behind) return Status::Ok();
  }
  attempt->is_whole = true;
  Measure(attempt);
  return Status::Ok();
}

void Portfolio::Measure(Attempt* attempt) const {
  const Explanation left =
      MeasureExplanation(fit_, graphs_[attempt->graph], attempt->state, kUnmatchedWidth);
  // What noise leaves unmatched by itself.
  const double by_noise = std::pow(kResidualPerNoise * fit_.noise / kUnmatchedWidth, 2);
  const auto [better, worse] = std::minmax(left.unmatched.source, left.unmatched.target);
  attempt->unmatched = better - by_noise;
  attempt->worse = worse - by_noise + left.lost_area;
  attempt->is_explained = attempt->unmatched < kExplained;
  attempt->is_partial = worse > kPartial;
  attempt->left = left.AmongWays() + attempt->hypothesis.handicap -
                  (attempt->is_explained ? kExplainedBonus : 0.0);
}

StatusOr<std::vector<Attempt>> Portfolio::Try(FitResult* result) const {
  const std::vector<Hypothesis> hypotheses = ListHypotheses(fit_);
  std::vector<Attempt> attempts;
  double unmatched = std::numeric_limits<double>::infinity();
  double worse = unmatched;
  double best = unmatched;
  bool is_partial = true;
  bool is_stopped = false;
  for (std::size_t i = 0; i < hypotheses.size() && !is_stopped; ++i) {
    const Hypothesis& hypothesis = hypotheses[i];
    const bool is_needed = unmatched >= hypothesis.needed_above ||
                           (is_partial && hypothesis.needed_if_partial) ||
                           worse >= hypothesis.needed_above_worse;
    if (!is_needed) continue;
    for (DeformationState& start : StartsOf(hypothesis)) {
      Attempt attempt;
      attempt.hypothesis = hypothesis;
      attempt.state = std::move(start);
      attempt.progress = static_cast<double>(i + 1) / static_cast<double>(hypotheses.size());
      if (Status status = Follow(best, &attempt, result); !status.ok()) return status;
      if (attempt.is_whole) {
        unmatched = std::min(unmatched, attempt.unmatched);
        worse = std::min(worse, attempt.worse);
        best = std::min(best, attempt.left);
        is_partial = is_partial && attempt.is_partial;
        attempts.push_back(std::move(attempt));
      }
      is_stopped = result->EndedEarly();
      if (is_stopped) break;
    }
  }
  if (attempts.empty()) {
    // There was no intrinsic start, and no other way was chosen: the source stays where it is.
    Attempt rest;
    rest.hypothesis = hypotheses.front();
    rest.state = DeformationState(graphs_[0].graph.num_nodes());
    attempts.push_back(std::move(rest));
    if (!MustEnd(fit_, result)) result->status = SolveStatus::kMaxIterations;
  }
  Rank(&attempts, result);
  return attempts;
}

void Portfolio::Rank(std::vector<Attempt>* attempts, FitResult* result) const {
  std::stable_sort(attempts->begin(), attempts->end(), [](const Attempt& a, const Attempt& b) {
    return a.left < b.left;
  });
  // The best careful way and the best bold one are compared.
  WayAgreement ways;
  std::set<double> widths;
  for (const Attempt& attempt : *attempts) {
    if (!widths.insert(attempt.hypothesis.loss_width).second) continue;
    ways.Add(*fit_.source, graphs_[attempt.graph], attempt.state, attempt.left);
  }
  result->evidence.disagreement = ways.Disagreement();
}

std::vector<Attempt> Finalists(std::vector<Attempt> attempts) {
  std::vector<Attempt> finalists;
  for (Attempt& attempt : attempts) {
    const bool is_near = finalists.empty() || attempt.left < finalists[0].left + kFinalistMargin;
    const bool is_new =
        std::none_of(finalists.begin(), finalists.end(), [&](const Attempt& finalist) {
          return attempt.graph == finalist.graph &&
                 MeanDistance(attempt.state, finalist.state) < kSameWarp;
        });
    if (is_near && is_new) finalists.push_back(std::move(attempt));
    if (finalists.size() == kFinalists || finalists[0].is_explained) break;
  }
  return finalists;
}

}  // namespace ceres_ed
