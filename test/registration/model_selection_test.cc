// Fits to targets that differ from the source by a rigid motion alone, or by little more.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/simulation/views.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <glog/logging.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

Similarity Turn() {
  Similarity pose;
  pose.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.3, 1.0, 0.5).normalized());
  pose.translation = Eigen::Vector3d(0.02, -0.01, 0.03);
  return pose;
}

PointCloud Kidney(int vertices) {
  return MakeSyntheticShape(SyntheticShape::kKidney, vertices, 1.0);
}

// Presses the side of a body in, by `depth` at most and within a few node spacings.
void Dent(double depth, PointCloud* body) {
  const Eigen::AlignedBox3d box = BoundingBox(body->points);
  const Eigen::Vector3d place = box.center() + Eigen::Vector3d(0.0, 0.5 * box.sizes().y(), 0.0);
  for (Eigen::Vector3d& point : body->points) {
    const double distance = (point - place).norm() / (0.15 * box.diagonal().norm());
    point.y() -= depth * std::exp(-distance * distance);
  }
  body->normals.clear();
}

void Move(const Similarity& pose, PointCloud* cloud) {
  for (Eigen::Vector3d& point : cloud->points) point = pose * point;
  cloud->normals.clear();
}

FitResult FitTo(const PointCloud& source, const PointCloud& target) {
  StatusOr<FitResult> result = Fit(source, target);
  CHECK(result.ok()) << result.status().message();
  return *std::move(result);
}

// Returns the largest change of a distance to the first point.
double LargestChange(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double largest = 0.0;
  for (std::size_t p = 1; p < a.size(); ++p) {
    largest = std::max(largest, std::abs((a[p] - a[0]).norm() - (b[p] - b[0]).norm()));
  }
  return largest;
}

double MeanError(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double sum = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p) sum += (a[p] - b[p]).norm();
  return sum / static_cast<double>(a.size());
}

class RigidCopy : public ::testing::TestWithParam<double> {};

TEST_P(RigidCopy, StaysRigid) {
  const PointCloud source = Kidney(1500);
  PointCloud target = Kidney(1900);
  AddSyntheticNoise(GetParam() * Diagonal(target.points), 7, &target);
  Move(Turn(), &target);
  const FitResult fit = FitTo(source, target);
  EXPECT_TRUE(fit.rigid_suffices);
  EXPECT_FALSE(fit.rigid_only);
  EXPECT_LT(LargestChange(fit.points, source.points), 1e-9);
  PointCloud truth = source;
  Move(Turn(), &truth);
  EXPECT_LT(MeanError(fit.points, truth.points), 0.001 * Diagonal(source.points));
}

INSTANTIATE_TEST_SUITE_P(Noise, RigidCopy, ::testing::Values(0.0, 0.003), [](const auto& info) {
  return info.param == 0.0 ? "None" : "ThreePerMille";
});

TEST(ModelSelection, KeepsADentThatFewNodesSee) {
  const PointCloud source = Kidney(1500);
  PointCloud target = Kidney(1900);
  Dent(0.02 * Diagonal(source.points), &target);
  AddSyntheticNoise(0.001 * Diagonal(target.points), 7, &target);
  EXPECT_FALSE(FitTo(source, target).rigid_suffices);
}

TEST(ModelSelection, KeepsASlightStretchOfTheWholeBody) {
  const PointCloud source = Kidney(1500);
  PointCloud target = Kidney(1900);
  for (Eigen::Vector3d& point : target.points) point.z() *= 1.02;
  target.normals.clear();
  EXPECT_FALSE(FitTo(source, target).rigid_suffices);
}

TEST(ModelSelection, LeavesWhatLandmarksAskFor) {
  FitInput input;
  input.source = Kidney(1500);
  input.target = Kidney(1900);
  input.landmarks = {{0, input.source.points[0]}};
  const StatusOr<FitResult> fit = Fit(input, {}, BuiltinEnergies());
  ASSERT_TRUE(fit.ok()) << fit.status().message();
  EXPECT_FALSE(fit->rigid_suffices);
}

}  // namespace
}  // namespace ceres_ed
