#include "ceres_ed/registration/hypotheses/hypothesis.h"

#include <ceres_ed/graph/warp.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace ceres_ed {
namespace {

// How strict a hypothesis is about pairs; the values are options of the fit.
enum class Manner {
  // A narrow loss and strict normals on the coarse graphs: limbs that are far from the target wait
  // until the part that carries them is near.
  kCareful,
  // A wide loss and loose normals: limbs move at once.
  kBold,
  // A narrow loss, and strict normals on the finest graph, too: nothing turns to a wrong limb.
  kStrict,
};

// What is fixed about a hypothesis.
struct Recipe {
  const char* name;
  HypothesisStart start;
  Manner manner;
  double needed_above;
};

// Less than this share is nothing, and less than that is little: what a coarse graph cannot follow.
constexpr double kNothing = 0.01;
constexpr double kLittle = 0.03;

// The hypotheses in the order in which they are tried.
constexpr Recipe kRecipes[] = {
    {"careful", HypothesisStart::kPlaced, Manner::kCareful, 0.0},
    {"bold", HypothesisStart::kPlaced, Manner::kBold, kNothing},
    {"intrinsic", HypothesisStart::kIntrinsic, Manner::kBold, kLittle},
    {"given_careful", HypothesisStart::kGiven, Manner::kCareful, kLittle},
    {"given_bold", HypothesisStart::kGiven, Manner::kBold, kLittle},
    {"strict", HypothesisStart::kPlaced, Manner::kStrict, kLittle},
};

// How far the rigid stage has moved the source from the given pose, as a part of its diagonal. The
// unit frame has the source's centre as its origin, and its diagonal as the unit.
double MotionFromGiven(const UnitFit& fit) {
  const Similarity& motion = fit.given_from_placed;
  const double angle = motion.rotation.angularDistance(Eigen::Quaterniond::Identity());
  return motion.translation.norm() + 0.5 * angle;
}

// A surface of which less than this is left has all its limbs in their places.
constexpr double kWhole = 0.05;
// The first stiffness of a source that is bent already lies this part of the way to the last one.
constexpr double kBentShare = 0.8;
// The angle of the strict manner, as a part of that of the careful one.
constexpr double kStrictness = 0.9;
// A motion below the first of these is none; above the second one it is far.
constexpr double kLeastMotion = 0.01;
constexpr double kFarMotion = 0.25;
// The handicap of a hypothesis that starts far from the given pose.
constexpr double kFarHandicap = 0.01;

Hypothesis MakeHypothesis(const Recipe& recipe, const UnitFit& fit) {
  const FitOptions& options = *fit.options;
  const double motion = MotionFromGiven(fit);
  const double bold_angle = options.matching.max_angle_deg;
  const double careful_angle = std::min(options.careful_angle_deg, bold_angle);
  Hypothesis hypothesis;
  hypothesis.name = recipe.name;
  hypothesis.start = recipe.start;
  const bool is_bold = recipe.manner == Manner::kBold;
  hypothesis.loss_width = is_bold ? options.loss_width : options.careful_loss_width;
  hypothesis.coarse_angle_deg = is_bold ? bold_angle : careful_angle;
  hypothesis.fine_angle_deg = bold_angle;
  if (recipe.manner == Manner::kStrict) {
    hypothesis.coarse_angle_deg = kStrictness * careful_angle;
    hypothesis.fine_angle_deg = hypothesis.coarse_angle_deg;
  }
  hypothesis.needed_above = recipe.needed_above;
  if (recipe.start == HypothesisStart::kIntrinsic) {
    hypothesis.needed_above_worse = kWhole;
  } else if (recipe.start == HypothesisStart::kPlaced) {
    hypothesis.handicap = kFarHandicap * std::min(1.0, motion / (2.0 * kFarMotion));
  } else {
    hypothesis.needed_if_partial = motion > kFarMotion && recipe.manner == Manner::kCareful;
  }
  return hypothesis;
}

// Returns whether a hypothesis can start there, and differs from those that start elsewhere.
bool IsStart(const UnitFit& fit, HypothesisStart start) {
  if (start == HypothesisStart::kGiven) return MotionFromGiven(fit) > kLeastMotion;
  if (start == HypothesisStart::kIntrinsic) return fit.landmarks.empty() && fit.fixed.empty();
  return true;
}

std::vector<std::string> Split(const std::string& names) {
  std::vector<std::string> parts;
  std::istringstream stream(names);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

}  // namespace

ResolutionPlan Hypothesis::Apply(ResolutionPlan plan, bool is_finest) const {
  plan.loss_width = loss_width;
  plan.max_angle_deg = is_finest ? fine_angle_deg : coarse_angle_deg;
  if (start == HypothesisStart::kIntrinsic && !is_finest) {
    plan.first_stiffness *= std::pow(plan.last_stiffness / plan.first_stiffness, kBentShare);
    plan.steps = std::max(1, plan.steps - 1);
  }
  return plan;
}

std::vector<std::string> HypothesisNames() {
  std::vector<std::string> names;
  for (const Recipe& recipe : kRecipes) names.emplace_back(recipe.name);
  return names;
}

std::string CheckHypothesisNames(const std::string& names) {
  const std::vector<std::string> known = HypothesisNames();
  std::set<std::string> seen;
  for (const std::string& name : Split(names)) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::string expected;
      for (const std::string& one : known) expected += (expected.empty() ? "" : ", ") + one;
      return "hypotheses has '" + name + "', expected some of " + expected;
    }
    if (!seen.insert(name).second) return "hypotheses has '" + name + "' twice";
  }
  return "";
}

std::vector<Hypothesis> ListHypotheses(const UnitFit& fit) {
  const FitOptions& options = *fit.options;
  const std::vector<std::string> chosen = Split(options.hypotheses);
  const bool is_one_way = fit.target == nullptr || options.loss == LossType::kSquared;
  std::vector<Hypothesis> hypotheses;
  for (const Recipe& recipe : kRecipes) {
    const bool is_chosen =
        chosen.empty() || std::find(chosen.begin(), chosen.end(), recipe.name) != chosen.end();
    if (!is_chosen || !IsStart(fit, recipe.start)) continue;
    hypotheses.push_back(MakeHypothesis(recipe, fit));
    if (is_one_way) break;
  }
  if (hypotheses.empty()) hypotheses.push_back(MakeHypothesis(kRecipes[0], fit));
  return hypotheses;
}

DeformationState StartOf(const Hypothesis& hypothesis,
                         const UnitFit& fit,
                         const BuiltGraph& graph) {
  DeformationState state(graph.graph.num_nodes());
  if (hypothesis.start == HypothesisStart::kPlaced) return state;
  const Similarity& motion = fit.given_from_placed;
  const Eigen::Matrix3d R = motion.rotation.toRotationMatrix();
  for (int j = 0; j < state.num_nodes(); ++j) {
    const Eigen::Vector3d& node = graph.graph.position(j);
    MutableNodeAffine(state.node(j)) = R;
    MutableNodeTranslation(state.node(j)) = motion * node - node;
  }
  return state;
}

}  // namespace ceres_ed
