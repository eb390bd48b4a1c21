#include <ceres_ed/geometry/similarity.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

Similarity Example() {
  Similarity s;
  s.scale = 2.5;
  s.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(2.9, Eigen::Vector3d(1, 2, -1).normalized()));
  s.translation = {4, -5, 6};
  return s;
}

std::vector<Eigen::Vector3d> Transformed(const Similarity& s,
                                         const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> result;
  for (const Eigen::Vector3d& point : points) result.push_back(s * point);
  return result;
}

TEST(Similarity, InverseUndoesAndProductComposes) {
  const Similarity a = Example();
  Similarity b = Example();
  b.scale = 0.3;
  b.rotation = b.rotation.conjugate();
  for (const Eigen::Vector3d& point : RandomPoints(10, 21)) {
    EXPECT_LT((a.Inverse() * (a * point) - point).norm(), 1e-14);
    EXPECT_LT(((a * b) * point - a * (b * point)).norm(), 1e-13);
  }
}

TEST(Similarity, FitPointsFindsTheTransformation) {
  const Similarity truth = Example();
  const std::vector<Eigen::Vector3d> from = RandomPoints(20, 22);
  const auto fit = Similarity::FitPoints(from, Transformed(truth, from), true);
  ASSERT_TRUE(fit.ok()) << fit.status().message();
  EXPECT_NEAR(fit->scale, truth.scale, 1e-14);
  EXPECT_LT(fit->rotation.angularDistance(truth.rotation), 1e-7);
  EXPECT_LT((fit->translation - truth.translation).norm(), 1e-13);
}

TEST(Similarity, FitPointsKeepsScaleOneUnlessAsked) {
  Similarity truth = Example();
  const std::vector<Eigen::Vector3d> from = RandomPoints(20, 23);
  const auto fit = Similarity::FitPoints(from, Transformed(truth, from), false);
  ASSERT_TRUE(fit.ok());
  EXPECT_EQ(fit->scale, 1.0);
  EXPECT_LT(fit->rotation.angularDistance(truth.rotation), 1e-7);
}

TEST(Similarity, FitPointsMinimisesTheSumOfSquares) {
  const std::vector<Eigen::Vector3d> from = RandomPoints(15, 24);
  std::vector<Eigen::Vector3d> to = Transformed(Example(), from);
  const std::vector<Eigen::Vector3d> noise = RandomPoints(15, 25, 0.5);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += noise[i];
  const auto fit = Similarity::FitPoints(from, to, true);
  ASSERT_TRUE(fit.ok());
  const auto cost = [&](const Similarity& s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < to.size(); ++i) sum += (s * from[i] - to[i]).squaredNorm();
    return sum;
  };
  const double best = cost(*fit);
  for (int i = 0; i < 3; ++i) {
    for (const double step : {-1e-3, 1e-3}) {
      Similarity moved = *fit;
      moved.translation[i] += step;
      EXPECT_GT(cost(moved), best);
      Similarity turned = *fit;
      turned.rotation = Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(i)) * fit->rotation;
      EXPECT_GT(cost(turned), best);
      Similarity scaled = *fit;
      scaled.scale *= 1.0 + step;
      EXPECT_GT(cost(scaled), best);
    }
  }
}

TEST(Similarity, FitPointsToAReflectionIsStillARotation) {
  const std::vector<Eigen::Vector3d> from = RandomPoints(15, 26);
  std::vector<Eigen::Vector3d> to = from;
  for (Eigen::Vector3d& point : to) point.z() = -point.z();
  const auto fit = Similarity::FitPoints(from, to, false);
  ASSERT_TRUE(fit.ok());
  EXPECT_NEAR(fit->rotation.toRotationMatrix().determinant(), 1.0, 1e-12);
}

TEST(Similarity, FitPointsWorksOnAPlane) {
  const Similarity truth = Example();
  const std::vector<Eigen::Vector3d> from = MakeGridMesh(3, 3).points;
  const auto fit = Similarity::FitPoints(from, Transformed(truth, from), true);
  ASSERT_TRUE(fit.ok());
  EXPECT_LT(fit->rotation.angularDistance(truth.rotation), 1e-7);
}

TEST(Similarity, FitPointsRefusesWhatLeavesTheRotationOpen) {
  const std::vector<Eigen::Vector3d> two = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(Similarity::FitPoints(two, two).ok());
  const std::vector<Eigen::Vector3d> line = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {5, 5, 0}};
  EXPECT_FALSE(Similarity::FitPoints(line, line).ok());
  const std::vector<Eigen::Vector3d> nan(3, Eigen::Vector3d::Constant(std::nan("")));
  EXPECT_FALSE(Similarity::FitPoints(nan, nan).ok());
}

}  // namespace
}  // namespace ceres_ed
