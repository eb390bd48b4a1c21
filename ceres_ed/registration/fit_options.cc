#include "ceres_ed/registration/fit_options.h"

#include <ceres_ed/registration/hypotheses/hypothesis.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <thread>

namespace ceres_ed {
namespace {

constexpr int kMaxLevels = 5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

const OptionTable<MatchingOptions>& MatchingOptions::Rows() {
  using O = MatchingOptions;
  static const OptionTable<O> rows({
      Row(&O::max_distance, "max_distance", "No pair is farther apart than this.")
          .In(AboveOrInfinite(0))
          .Unit("target units")
          .Special(0, kInfinity, "unlimited")
          .Main(),
      Row(&O::max_angle_deg, "max_angle_deg", "No pair has normals that differ by more.")
          .In(AboveUpTo(0, 180))
          .Unit("degrees")
          .Main(),
      Row(&O::max_deviations,
          "max_deviations",
          "No pair is farther apart than this many robust standard deviations of all distances.")
          .In(AboveOrInfinite(0))
          .Special(0, kInfinity, "unlimited"),
      Row(&O::reject_borders,
          "reject_borders",
          "Leave out pairs whose closest point is on the border of its surface."),
      Row(&O::symmetric_normals,
          "symmetric_normals",
          "Measure distances along the mean of both normals, not along the target's."),
      Row(&O::resolution, "resolution", "Pairs as near as this are kept in any case.")
          .In(AtLeast(0)),
      Row(&O::with_details, "with_details", "Record what added energies need to know of a pair."),
      Row(&O::num_threads, "num_threads", "The result does not depend on it.").In(AtLeast(1)),
  });
  return rows;
}

bool MatchingOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

const OptionTable<RigidOptions>& RigidOptions::Rows() {
  using O = RigidOptions;
  static const OptionTable<O> rows({
      Row(&O::with_scale, "scale", "The rigid motion also changes the size.").Main(),
      Row(&O::initial_scale,
          "initial_scale",
          "The source is multiplied by this before anything else; see --scale.")
          .In(Above(0)),
      Row(&O::max_angle_deg,
          "max_angle_deg",
          "No pair of the rigid stage has normals that differ by more.")
          .In(AboveUpTo(0, 180))
          .Unit("degrees"),
      Row(&O::score_width,
          "score_width",
          "A point this far away counts half as unmatched, as a part of the target's diagonal.")
          .In(Above(0)),
      Row(&O::good_score,
          "good_score",
          "The given pose is kept if less than this part of a surface is unmatched.")
          .In(Between(0, 1)),
      Row(&O::preference,
          "preference",
          "Another pose must miss less than this times what the given pose misses.")
          .In(AboveUpTo(0, 1)),
      Row(&O::num_threads, "num_threads", "The result does not depend on it.").In(AtLeast(1)),
      NotData(&O::both_sides),
      NotData(&O::should_stop),
  });
  return rows;
}

bool RigidOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

const OptionTable<FinishOptions>& FinishOptions::Rows() {
  using O = FinishOptions;
  static const OptionTable<O> rows({
      Row(&O::rounds, "rounds", "The rounds of matching in the finish.").In(AtLeast(1)),
      Row(&O::steps, "steps", "The solves in each round of the finish.").In(AtLeast(1)),
      Row(&O::smoothing, "smoothing", "Shorter waves of the displacement are flattened.")
          .In(Above(0))
          .Unit("edge lengths"),
      Row(&O::max_smoothing,
          "max_smoothing",
          "There is no finish if noise asks for a longer smoothing than this.")
          .In(AtLeast(0))
          .Unit("edge lengths"),
      Row(&O::fade, "fade", "A displacement fades over this length where nothing is matched.")
          .In(Above(0))
          .Unit("edge lengths"),
      Row(&O::point_to_point_share,
          "point_to_point_share",
          "The share of point-to-point in the finish; the rest is point-to-plane.")
          .In(Between(0, 1)),
      Row(&O::loss_width, "loss_width", "The width of the loss in the finish.")
          .In(Above(0))
          .Unit("robust standard deviations"),
  });
  return rows;
}

bool FinishOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

const OptionTable<FitWeights>& FitWeights::Rows() {
  using O = FitWeights;
  static const OptionTable<O> rows({
      Row(&O::rotation, "w_rot", "The weight of E_rot, which keeps each node near a rotation.")
          .In(AtLeast(0))
          .Main(),
      Row(&O::regularization, "w_reg", "The weight of E_reg, which makes neighbours agree.")
          .In(AtLeast(0))
          .Main(),
      Row(&O::volume,
          "w_volume",
          "The weight of edges to nodes inside SOURCE, relative to those along its surface.")
          .In(AtLeast(0)),
      Row(&O::data, "w_data", "The weight of the distance to TARGET.").In(AtLeast(0)).Main(),
      Row(&O::landmark, "w_landmark", "The weight of the landmarks.").In(AtLeast(0)),
      Row(&O::fixed, "w_fixed", "The weight of the points that must not move.").In(AtLeast(0)),
      Row(&O::point_to_point_share,
          "point_to_point_share",
          "The share of w_data that goes to point-to-point for a sheet; a closed body has less.")
          .In(Between(0, 1)),
  });
  return rows;
}

const OptionTable<FitSchedule>& FitSchedule::Rows() {
  using O = FitSchedule;
  static const OptionTable<O> rows({
      Row(&O::levels, "levels", "The graphs that are fitted one after the other, coarse to fine.")
          .In(Between(1, kMaxLevels)),
      Row(&O::initial_stiffness, "initial_stiffness", "The factor of w_rot and w_reg at the start.")
          .In(Above(0)),
      Row(&O::final_stiffness,
          "final_stiffness",
          "The factor of w_rot and w_reg at the end, for a target without noise.")
          .In(Above(0)),
      Row(&O::noise_stiffness, "noise_stiffness", "How much noise adds to both factors.")
          .In(AtLeast(0)),
      Row(&O::coarse_steps, "coarse_steps", "The steps of stiffness on all coarser graphs.")
          .In(AtLeast(1)),
      Row(&O::fine_steps, "fine_steps", "The steps of stiffness on the last graph.").In(AtLeast(1)),
      Row(&O::max_rounds, "max_rounds", "The rounds of matching and solving in each step.")
          .In(AtLeast(1)),
      Row(&O::tolerance,
          "tolerance",
          "The surface stands still if its mean motion is less than this part of its diagonal.")
          .In(Above(0)),
      Row(&O::solver_iterations, "solver_iterations", "The iterations of the solver in a round.")
          .In(AtLeast(1)),
  });
  return rows;
}

const OptionTable<FitOptions>& FitOptions::Rows() {
  using O = FitOptions;
  static const OptionTable<O> rows({
      Nested(&O::strategy, StrategyOptions::Rows()),
      Nested(
          &O::graph, GraphOptions::Rows(), "graph_", {"node_spacing", "target_nodes", "neighbors"})
          .Internal("graph_threads"),
      Row(&O::volume,
          "volume",
          "Whether SOURCE is a body with nodes inside; auto: if it is closed.")
          .Main(),
      Nested(&O::weights, FitWeights::Rows()),
      Nested(&O::schedule, FitSchedule::Rows()),
      Row(&O::loss, "loss", "The robust loss of the distance to TARGET.").Main(),
      Row(&O::loss_width, "loss_width", "The width of the loss.")
          .In(Above(0))
          .Unit("robust standard deviations"),
      Row(&O::careful_loss_width,
          "careful_loss_width",
          "The width of the loss when a coarse graph is fitted the careful way.")
          .In(Above(0))
          .Unit("robust standard deviations"),
      Row(&O::careful_angle_deg,
          "careful_angle_deg",
          "The largest angle between normals when a coarse graph is fitted the careful way.")
          .In(AboveUpTo(0, 180))
          .Unit("degrees"),
      Row(&O::hypotheses,
          "hypotheses",
          "The ways to follow TARGET on a coarse graph that are tried, with commas; empty = all."),
      Nested(&O::matching, MatchingOptions::Rows(), "match_", {"max_distance", "max_angle_deg"})
          .Internal("match_resolution")
          .Internal("match_with_details")
          .Internal("match_num_threads"),
      Row(&O::max_samples, "max_samples", "The points of each surface that are matched.")
          .In(AtLeast(10)),
      Row(&O::denoise, "denoise", "Smooth a noisy TARGET before it is followed."),
      Row(&O::rigid_first, "rigid_first", "Find a rigid motion before anything bends.").Main(),
      Nested(&O::rigid, RigidOptions::Rows(), "rigid_").Internal("rigid_num_threads"),
      NotData(&O::extra_energies),
      Row(&O::finish, "finish", "Move every point onto TARGET at the end.").Main(),
      Nested(&O::finish_options, FinishOptions::Rows(), "finish_"),
      Row(&O::unfold, "unfold", "Lay faces flat again that the fit has folded over."),
      Row(&O::covariance, "covariance", "Work out how well every point is determined.").Main(),
      NotData(&O::record_rounds),
      Row(&O::num_threads, "threads", "The threads; the result does not depend on them.")
          .In(AtLeast(1))
          .Special(0, std::max(1u, std::thread::hardware_concurrency()), "auto")
          .Main(),
      Row(&O::time_limit_s, "time_limit_s", "The time after which the best result is taken.")
          .In(AboveOrInfinite(0))
          .Unit("seconds")
          .Special(0, kInfinity, "none")
          .Main(),
      NotData(&O::should_stop),
      NotData(&O::on_progress),
  });
  return rows;
}

bool FitOptions::IsValid(std::string* error) const {
  if (!Rows().Check(*this, error)) return false;
  if (*error = CheckHypothesisNames(hypotheses); !error->empty()) return false;
  if (schedule.initial_stiffness >= schedule.final_stiffness) return true;
  double initial = schedule.initial_stiffness;
  double final = schedule.final_stiffness;
  *error = "initial_stiffness is " + OptionText(&initial) +
           ", expected at least final_stiffness, " + "which is " + OptionText(&final);
  return false;
}

}  // namespace ceres_ed
