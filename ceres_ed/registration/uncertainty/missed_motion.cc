#include "ceres_ed/registration/uncertainty/missed_motion.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// The motion of modes of one degree, and what is missed of it.
struct Motion {
  double whole = 0.0;
  double missed = 0.0;
};

}  // namespace

MissedMotion::MissedMotion(const DeformationGraph& graph,
                           const DeformationState& state,
                           const std::vector<char>& is_observed,
                           const std::vector<SmoothMode>& modes,
                           const std::vector<Eigen::VectorXd>& held_back) {
  // Linear fields, and quadratic ones, which are smaller within the unit frame and count as much.
  std::array<Motion, 2> of_degree;
  double square = 0.0;
  double count = 0.0;
  for (int j = 0; j < graph.num_nodes(); ++j) {
    if (is_observed[j] == 0) continue;
    square += NodeTranslation(state.node(j)).squaredNorm();
    count += 1.0;
    for (std::size_t m = 0; m < held_back.size(); ++m) {
      const SmoothMode& mode = modes[m];
      const bool is_linear = mode.powers[0] + mode.powers[1] + mode.powers[2] == 1;
      Motion& motion = of_degree[is_linear ? 0 : 1];
      const double value = mode.Value(graph.position(j));
      const double* const missed = held_back[m].data() + static_cast<std::ptrdiff_t>(kNodeSize) * j;
      motion.whole += value * value;
      motion.missed += value * NodeTranslation(missed)[mode.axis];
    }
  }
  for (const Motion& motion : of_degree) {
    if (motion.whole == 0.0) continue;
    // Rounding, and modes that help each other, may make it negative.
    share_ += 0.5 * std::clamp(motion.missed / motion.whole, 0.0, 1.0);
  }
  if (count > 0.0) variance_ = kWaves * share_ * square / (3.0 * count);
}

Eigen::Matrix3d MissedMotion::Covariance(double seen, const Eigen::Vector3d& normal) const {
  const Eigen::Matrix3d across = normal * normal.transpose();
  return variance_ * (Eigen::Matrix3d::Identity() - (1.0 - kAcross) * seen * across);
}

}  // namespace ceres_ed
