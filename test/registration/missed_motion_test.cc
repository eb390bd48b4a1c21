#include "ceres_ed/registration/uncertainty/missed_motion.h"

#include <vector>

#include <cost_functions/node_parameters.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Nodes on a grid of a unit cube around the origin, which have moved by `motion`.
struct Cube {
  explicit Cube(const Eigen::Vector3d& motion) : state(kNodes) {
    for (int i = 0; i < kNodes; ++i) {
      graph.AddNode(0.25 * Eigen::Vector3i(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2).cast<double>());
      MutableNodeTranslation(state.node(i)) = motion;
    }
    modes = FindSmoothModes(graph, state, std::vector<char>(kNodes, 1));
  }

  // What is missed of the modes if the fit holds back the share `linear` of the linear ones and
  // `quadratic` of the others.
  std::vector<Eigen::VectorXd> HeldBack(double linear, double quadratic) const {
    std::vector<Eigen::VectorXd> missed;
    for (const SmoothMode& mode : modes) {
      const bool is_linear = mode.powers[0] + mode.powers[1] + mode.powers[2] == 1;
      missed.push_back((is_linear ? linear : quadratic) * NodeMotion(mode, graph));
    }
    return missed;
  }

  MissedMotion Missed(double linear, double quadratic) const {
    return {graph, state, std::vector<char>(kNodes, 1), modes, HeldBack(linear, quadratic)};
  }

  static constexpr int kNodes = 125;
  DeformationGraph graph;
  DeformationState state;
  std::vector<SmoothMode> modes;
};

TEST(MissedMotion, IsNothingWhereTheDataShowAllOrNothingMoved) {
  EXPECT_TRUE(Cube({0.1, 0.0, 0.2}).Missed(0.0, 0.0).Covariance(1.0, {0, 0, 1}).isZero(1e-20));
  EXPECT_TRUE(Cube({0.0, 0.0, 0.0}).Missed(0.3, 0.3).Covariance(1.0, {0, 0, 1}).isZero(1e-20));
  EXPECT_TRUE(MissedMotion().Covariance(0.0, {0, 0, 1}).isZero(0.0));
  const Cube cube({0.1, 0.0, 0.0});
  const MissedMotion no_priors(cube.graph, cube.state, std::vector<char>(125, 1), cube.modes, {});
  EXPECT_EQ(no_priors.share(), 0.0);
}

TEST(MissedMotion, GrowsWithTheShareThatIsHeldBackAndWithTheMotion) {
  const Cube cube({0.1, 0.0, 0.2});
  const MissedMotion missed = cube.Missed(0.2, 0.4);
  EXPECT_NEAR(missed.share(), 0.3, 1e-12);
  const double variance = MissedMotion::kWaves * 0.3 * (0.01 + 0.04) / 3.0;
  const Eigen::Matrix3d hidden = missed.Covariance(0.0, {0, 0, 1});
  EXPECT_TRUE(hidden.isApprox(variance * Eigen::Matrix3d::Identity(), 1e-12));
}

// Distances show how far a seen surface is, not where it has slid.
TEST(MissedMotion, LiesWithinASeenSurface) {
  const MissedMotion missed = Cube({0.1, 0.0, 0.2}).Missed(0.2, 0.2);
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 2) / 3.0;
  const Eigen::Matrix3d seen = missed.Covariance(1.0, normal);
  const Eigen::Vector3d along = normal.cross(Eigen::Vector3d::UnitX()).normalized();
  EXPECT_NEAR(normal.dot(seen * normal), MissedMotion::kAcross * along.dot(seen * along), 1e-12);
}

// Whatever the modes say, no more than all of the motion counts.
TEST(MissedMotion, TakesSharesBetweenNothingAndAll) {
  EXPECT_EQ(Cube({0.1, 0.0, 0.0}).Missed(-0.5, -0.5).share(), 0.0);
  EXPECT_EQ(Cube({0.1, 0.0, 0.0}).Missed(3.0, 3.0).share(), 1.0);
}

}  // namespace
}  // namespace ceres_ed
