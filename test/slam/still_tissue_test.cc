#include "ceres_ed/slam/frame/still_tissue.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kNoFloor = 1e-9;

// Returns residuals of `num_nodes` nodes with 20 points each, in groups of `shared` points that
// have the same error of deviation 1.
std::vector<NodeResidual> Noise(int num_nodes, int shared) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  std::vector<NodeResidual> residuals;
  for (int node = 0; node < num_nodes; ++node) {
    double error = 0.0;
    for (int i = 0; i < 20; ++i) {
      if (i % shared == 0) error = normal(generator);
      residuals.push_back({node, error});
    }
  }
  return residuals;
}

PointMatch Moved(double x, const Eigen::Vector3d& by, double weight = 1.0) {
  const Eigen::Vector3d in_map(x, 0.0, 5.0);
  return {in_map, in_map + by, weight};
}

TEST(SpreadBetweenNodes, IsOneForNoiseOfAnySize) {
  std::vector<NodeResidual> residuals = Noise(400, 1);
  EXPECT_NEAR(SpreadBetweenNodes(residuals, 1.0, kNoFloor), 1.0, 0.15);
  for (NodeResidual& r : residuals) r.distance *= 1e-3;
  EXPECT_NEAR(SpreadBetweenNodes(residuals, 1.0, kNoFloor), 1.0, 0.15);
}

TEST(SpreadBetweenNodes, IsAboutOneForNoiseThatNeighboursShare) {
  EXPECT_NEAR(SpreadBetweenNodes(Noise(400, 4), 4.0, kNoFloor), 1.1, 0.2);
}

// Two nodes at m and -m, with residuals m +- 1 and -m +- 1 and n points each:
// F = (2 n m^2 / 2) / (2 n / (2 n - 2)) = m^2 (n - 1).
TEST(SpreadBetweenNodes, GrowsWithTheSquareOfTheMotion) {
  for (const double m : {0.5, 1.0, 3.0}) {
    std::vector<NodeResidual> residuals;
    for (int i = 0; i < 10; ++i) {
      residuals.push_back({7, m + (i % 2 == 0 ? 1.0 : -1.0)});
      residuals.push_back({2, -m + (i % 2 == 0 ? 1.0 : -1.0)});
    }
    EXPECT_NEAR(SpreadBetweenNodes(residuals, 1.0, kNoFloor), 9.0 * m * m, 1e-12);
  }
}

TEST(SpreadBetweenNodes, DoesNotCountNodesWithFewPoints) {
  EXPECT_EQ(SpreadBetweenNodes({}, 1.0, kNoFloor), 0.0);
  EXPECT_EQ(SpreadBetweenNodes({{0, 5.0}, {0, 5.1}, {1, -5.0}}, 1.0, kNoFloor), 0.0);
}

// Exact depth leaves nothing within a node, so that any error would be infinitely significant.
TEST(SpreadBetweenNodes, TakesNoDeviationForSmallerThanTheFloor) {
  std::vector<NodeResidual> residuals;
  for (int i = 0; i < 10; ++i) residuals.push_back({0, 0.001});
  EXPECT_NEAR(SpreadBetweenNodes(residuals, 1.0, 0.01), 10.0 * 0.01, 1e-12);
}

TEST(CornerCoherence, TellsACommonMotionFromErrors) {
  const Eigen::Vector3d by(0.1, 0.2, 0.0);
  EXPECT_DOUBLE_EQ(CornerCoherence({Moved(0, by), Moved(1, by)}, CameraPose(), 2.0).value, 1.0);
  EXPECT_DOUBLE_EQ(CornerCoherence({Moved(0, by), Moved(1, -by)}, CameraPose(), 2.0).value, -1.0);
  const Eigen::Vector3d across(0.2, -0.1, 0.0);
  EXPECT_NEAR(
      CornerCoherence({Moved(0, by), Moved(1, across)}, CameraPose(), 2.0).value, 0.0, 1e-12);
}

TEST(CornerCoherence, ComparesNeighboursThatCount) {
  const Eigen::Vector3d by(0.1, 0.2, 0.0);
  EXPECT_EQ(CornerCoherence({}, CameraPose(), 2.0).value, 0.0);
  EXPECT_EQ(CornerCoherence({Moved(0, by), Moved(3, by)}, CameraPose(), 2.0).value, 0.0);
  const std::vector<PointMatch> matches = {Moved(0, by), Moved(1, by), Moved(0.5, -by, 0.0)};
  EXPECT_DOUBLE_EQ(CornerCoherence(matches, CameraPose(), 2.0).value, 1.0);
}

// 30 corners in one place, with errors of a size but random directions: there are 435 pairs, and
// the mean square of a cosine in the plane is 1 / 2.
TEST(CornerCoherence, KnowsHowFarChanceMayTakeIt) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
  std::vector<PointMatch> matches;
  for (int k = 0; k < 30; ++k) {
    const double a = angle(generator);
    matches.push_back(Moved(0.01 * k, Eigen::Vector3d(std::cos(a), std::sin(a), 0.0)));
  }
  const Coherence coherence = CornerCoherence(matches, CameraPose(), 2.0);
  EXPECT_NEAR(coherence.deviation, 1.0 / std::sqrt(2.0 * 435.0), 0.003);
  EXPECT_LT(std::abs(coherence.value), 3.0 * coherence.deviation);
}

// The motion of the camera is that of all corners, and says nothing about the tissue.
TEST(CornerCoherence, DoesNotSeeTheMotionOfTheCamera) {
  const Eigen::Vector3d by(0.1, 0.2, 0.0);
  CameraPose camera;
  camera.translation = by;
  EXPECT_EQ(CornerCoherence({Moved(0, by), Moved(1, by)}, camera, 2.0).value, 0.0);
}

}  // namespace
}  // namespace ceres_ed
