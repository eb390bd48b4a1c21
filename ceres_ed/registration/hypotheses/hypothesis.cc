#include "ceres_ed/registration/hypotheses/hypothesis.h"

#include <ceres_ed/graph/warp.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace ceres_ed {
namespace {

// How strict a hypothesis is about pairs; the values are options of the fit.
enum class Manner { kCareful, kBold };

// What is fixed about a hypothesis.
struct Recipe {
  const char* name;
  HypothesisStart start;
  Manner manner;
  double max_distance;
  double stiffness;
};

constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

// The hypotheses in the order in which they are tried. Limbs that are far from the target wait in
// the careful way until the part that carries them is near; the bold way moves them at once.
constexpr Recipe kRecipes[] = {
    {"careful", HypothesisStart::kPlaced, Manner::kCareful, kAnyDistance, 1.0},
    {"bold", HypothesisStart::kPlaced, Manner::kBold, kAnyDistance, 1.0},
};

Hypothesis MakeHypothesis(const Recipe& recipe, const FitOptions& options) {
  const double bold_angle = options.matching.max_angle_deg;
  Hypothesis hypothesis;
  hypothesis.name = recipe.name;
  hypothesis.start = recipe.start;
  hypothesis.loss_width =
      recipe.manner == Manner::kCareful ? options.careful_loss_width : options.loss_width;
  hypothesis.max_angle_deg = recipe.manner == Manner::kCareful
                                 ? std::min(options.careful_angle_deg, bold_angle)
                                 : bold_angle;
  hypothesis.max_distance = recipe.max_distance;
  hypothesis.stiffness = recipe.stiffness;
  return hypothesis;
}

std::vector<std::string> Split(const std::string& names) {
  std::vector<std::string> parts;
  std::istringstream stream(names);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

// Returns whether the given pose is a start of its own.
bool IsStart(const UnitFit& fit, HypothesisStart start) {
  constexpr double kLeastMotion = 0.01;
  if (start == HypothesisStart::kPlaced) return true;
  const Similarity& motion = fit.given_from_placed;
  const double angle = motion.rotation.angularDistance(Eigen::Quaterniond::Identity());
  // The unit frame has the source's centre as its origin, and its diagonal as the unit.
  return motion.translation.norm() + 0.5 * angle > kLeastMotion;
}

}  // namespace

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
    hypotheses.push_back(MakeHypothesis(recipe, options));
    if (is_one_way) break;
  }
  if (hypotheses.empty()) hypotheses.push_back(MakeHypothesis(kRecipes[0], options));
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
