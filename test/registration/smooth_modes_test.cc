#include "ceres_ed/registration/uncertainty/smooth_modes.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Nodes on a grid of a unit cube around the origin.
DeformationGraph CubeGraph() {
  DeformationGraph graph;
  for (int i = 0; i < 125; ++i) {
    graph.AddNode(0.25 * Eigen::Vector3i(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2).cast<double>());
  }
  return graph;
}

template <typename Field>
std::vector<SmoothMode> ModesOf(const Field& displacement) {
  const DeformationGraph graph = CubeGraph();
  DeformationState state(graph.num_nodes());
  for (int j = 0; j < graph.num_nodes(); ++j) {
    MutableNodeTranslation(state.node(j)) = displacement(graph.position(j));
  }
  return FindSmoothModes(graph, state, std::vector<char>(graph.num_nodes(), 1));
}

double AmplitudeOf(const std::vector<SmoothMode>& modes, int degree) {
  for (const SmoothMode& mode : modes) {
    if (mode.powers[0] + mode.powers[1] + mode.powers[2] == degree) return mode.amplitude;
  }
  return -1.0;
}

TEST(SmoothModes, AreAllLinearAndQuadraticFields) {
  const auto modes = ModesOf([](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
  EXPECT_EQ(modes.size(), 3u * (3u + 6u));
  for (const SmoothMode& mode : modes) EXPECT_NEAR(mode.amplitude, 0.0, 1e-12);
}

TEST(SmoothModes, AmplitudeIsThatOfTheDeformation) {
  // One of 18 quadratic coefficients, and one of nine entries of the strain.
  const auto bent = ModesOf([](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return {0.0, 0.0, 0.3 * x.x() * x.x()};
  });
  EXPECT_NEAR(AmplitudeOf(bent, 2), 0.3 / std::sqrt(18.0), 0.01 * 0.3);
  EXPECT_NEAR(AmplitudeOf(bent, 1), 0.0, 1e-3);
  const auto stretched = ModesOf([](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return {0.1 * x.x(), 0.0, 0.0};
  });
  EXPECT_NEAR(AmplitudeOf(stretched, 1), 0.1 / 3.0, 1e-3);
}

TEST(SmoothModes, RotationIsNoStrain) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto turned =
      ModesOf([&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return turn * x - x; });
  // The ridge shrinks the displacement by a thousandth.
  EXPECT_LT(AmplitudeOf(turned, 1), 2e-3);
}

TEST(SmoothModes, HiddenNodesDoNotCount) {
  const DeformationGraph graph = CubeGraph();
  DeformationState state(graph.num_nodes());
  std::vector<char> is_observed(graph.num_nodes(), 1);
  is_observed[7] = 0;
  state.node(7)[kNodeTranslationOffset] = 100.0;
  for (const SmoothMode& mode : FindSmoothModes(graph, state, is_observed)) {
    EXPECT_EQ(mode.amplitude, 0.0);
  }
}

TEST(SmoothModes, NodesMoveAsTheFieldAndItsGradient) {
  const DeformationGraph graph = CubeGraph();
  const SmoothMode mode = {{1, 0, 1}, 1, 0.0};
  const Eigen::VectorXd motion = NodeMotion(mode, graph);
  for (int j = 0; j < graph.num_nodes(); ++j) {
    const Eigen::Vector3d& g = graph.position(j);
    const double* node = motion.data() + kNodeSize * j;
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    gradient(1, 0) = g.z();
    gradient(1, 2) = g.x();
    EXPECT_EQ(NodeAffine(node), gradient);
    EXPECT_EQ(NodeTranslation(node), Eigen::Vector3d(0.0, g.x() * g.z(), 0.0));
  }
}

}  // namespace
}  // namespace ceres_ed
