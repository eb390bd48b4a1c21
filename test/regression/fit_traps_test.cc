// Pairs on which tools of this kind are known to go wrong, made small: fingers beside each other,
// parts that touch, a vessel that may turn about its axis, one side of a body as bare points, and a
// body that is flat up to rounding. The truth is that of the generator.
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/meshing.h>
#include <ceres_ed/simulation/solid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

FitResult FitTo(const PointCloud& source, const PointCloud& target) {
  StatusOr<FitResult> result = Fit(source, target);
  EXPECT_TRUE(result.ok()) << result.status().message();
  return result.ok() ? *std::move(result) : FitResult();
}

// Returns the mean distance in percent of the diagonal of the truth.
double ErrorPercent(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<Eigen::Vector3d>& truth) {
  double sum = 0.0;
  for (std::size_t p = 0; p < truth.size(); ++p) sum += (points[p] - truth[p]).norm();
  return 100.0 * sum / static_cast<double>(truth.size()) / Diagonal(truth);
}

// A palm with four fingers along +y, which are 0.05 apart.
constexpr std::array<double, 4> kFingers = {-0.075, -0.025, 0.025, 0.075};
constexpr double kKnuckle = 0.12;

PointCloud Hand(int vertices) {
  SyntheticSolid solid(0.015);
  solid.Add({{{-0.05, 0.0, 0.0, 0.045}, {0.05, 0.0, 0.0, 0.045}}});
  solid.Add({{{-0.06, 0.07, 0.0, 0.04}, {0.06, 0.07, 0.0, 0.04}}});
  for (const double x : kFingers) {
    solid.Add({{{x, 0.08, 0.0, 0.019}, {x, 0.28 - 0.4 * std::abs(x), 0.0, 0.016}}});
  }
  return RemeshUniformly(MarchTetrahedra(solid, 0.008), solid, vertices);
}

// Bends each finger over its first centimetres: about x toward +z, and then about z.
std::vector<Eigen::Vector3d> Bend(const std::vector<Eigen::Vector3d>& points,
                                  const std::array<double, 4>& down,
                                  const std::array<double, 4>& aside) {
  std::vector<Eigen::Vector3d> bent;
  for (const Eigen::Vector3d& p : points) {
    std::size_t finger = 0;
    for (std::size_t f = 1; f < kFingers.size(); ++f) {
      if (std::abs(p.x() - kFingers[f]) < std::abs(p.x() - kFingers[finger])) finger = f;
    }
    const double s = std::clamp((p.y() - kKnuckle) / 0.06, 0.0, 1.0);
    const double share = s * s * (3.0 - 2.0 * s);
    const Eigen::Vector3d joint(kFingers[finger], kKnuckle, 0.0);
    const Eigen::AngleAxisd turn(share * down[finger], Eigen::Vector3d::UnitX());
    const Eigen::AngleAxisd swing(share * aside[finger], Eigen::Vector3d::UnitZ());
    bent.push_back(joint + swing * (turn * (p - joint)));
  }
  return bent;
}

TEST(FitTraps, FingersBesideEachOtherBendEachByItself) {
  const PointCloud source = Hand(3500);
  PointCloud target = Hand(5000);
  const std::array<double, 4> down = {0.35, 0.5, 0.6, 0.75};
  target.points = Bend(target.points, down, {});
  target.normals.clear();
  const std::vector<Eigen::Vector3d> truth = Bend(source.points, down, {});
  const FitResult result = FitTo(source, target);
  EXPECT_LT(ErrorPercent(result.points, truth), 1.0);
}

// Two fingers come together until their surfaces meet.
TEST(FitTraps, FingersThatTouchDoNotStickTogether) {
  const PointCloud source = Hand(3500);
  PointCloud target = Hand(5000);
  const std::array<double, 4> aside = {-0.09, -0.09, 0.09, 0.09};
  target.points = Bend(target.points, {}, aside);
  target.normals.clear();
  const std::vector<Eigen::Vector3d> truth = Bend(source.points, {}, aside);
  const FitResult result = FitTo(source, target);
  EXPECT_LT(ErrorPercent(result.points, truth), 1.0);
}

// A tube of length 0.2 along z.
PointCloud Tube(int around, int along) {
  PointCloud tube;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < along; ++k) {
      const double angle = 2.0 * M_PI * i / around;
      tube.points.emplace_back(
          0.02 * std::cos(angle), 0.02 * std::sin(angle), 0.2 * k / (along - 1) - 0.1);
    }
  }
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k + 1 < along; ++k) {
      const int a = i * along + k;
      const int b = (i + 1) % around * along + k;
      tube.triangles.push_back({a, b, b + 1});
      tube.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return tube;
}

Eigen::Vector3d Curved(const Eigen::Vector3d& p) {
  constexpr double kRadius = 0.2;
  const double angle = p.z() / kRadius;
  return {
      kRadius - (kRadius - p.x()) * std::cos(angle), p.y(), (kRadius - p.x()) * std::sin(angle)};
}

// A vessel that bends may turn about its axis at no cost. Nothing asks for a twist, though, or for
// a stretch.
TEST(FitTraps, AVesselIsNotTwisted) {
  const PointCloud source = Tube(30, 45);
  PointCloud target = Tube(37, 53);
  for (Eigen::Vector3d& p : target.points) p = Curved(p);
  const FitResult result = FitTo(source, target);
  ASSERT_EQ(result.points.size(), source.points.size());
  // How far the first and the last ring have turned about the axis, against where they belong.
  const auto turn = [&](int k) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d& p = source.points[i * 45 + k];
      // The point at the height of the ring before the bend.
      const Eigen::Vector3d& moved = result.points[i * 45 + k];
      const double angle = std::atan2(moved.z(), 0.2 - moved.x());
      const Eigen::Vector2d now(0.2 - std::hypot(moved.z(), 0.2 - moved.x()), moved.y());
      EXPECT_LT(std::abs(angle), 0.7);
      sum += Eigen::Vector2d(p.x() * now.x() + p.y() * now.y(), p.x() * now.y() - p.y() * now.x());
    }
    return std::atan2(sum.y(), sum.x());
  };
  const double twist = std::remainder(turn(44) - turn(0), 2.0 * M_PI);
  EXPECT_LT(std::abs(twist), 0.1);
  double longest = 0.0;
  for (int i = 0; i < 30; ++i) {
    double length = 0.0;
    for (int k = 0; k < 44; ++k) {
      length += (result.points[i * 45 + k + 1] - result.points[i * 45 + k]).norm();
    }
    longest = std::max(longest, length);
  }
  // The outer side of the bend.
  EXPECT_LT(longest, 0.2 * 1.1 * 1.05);
}

class OneSide : public ::testing::TestWithParam<const char*> {};

// The source shows all of a body, the target one side of it, and neither has faces.
TEST_P(OneSide, AsBarePointsIsFittedNearlyAsWellAsAMesh) {
  const std::string folder = std::string(CERES_ED_SOURCE_DIR) + "/data/" + GetParam() + "/";
  const auto load = [&](const std::string& name) {
    StatusOr<LoadedCloud> loaded = LoadCloud(folder + name);
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    return loaded.ok() ? std::move(loaded->cloud) : PointCloud();
  };
  PointCloud source = load("source.ply");
  PointCloud target = load("target.ply");
  const PointCloud truth = load("gt.ply");
  const double as_mesh = ErrorPercent(FitTo(source, target).points, truth.points);
  for (PointCloud* cloud : {&source, &target}) {
    cloud->triangles.clear();
    cloud->normals.clear();
  }
  EXPECT_LT(ErrorPercent(FitTo(source, target).points, truth.points), 1.3 * as_mesh);
}

INSTANTIATE_TEST_SUITE_P(FitTraps, OneSide, ::testing::Values("kidney_partial", "stomach_partial"));

// Both sides of a flat tube are one up to rounding, and a frame decides which points are one.
TEST(FitTraps, TheWarpOfABodyThatIsFlatUpToRoundingDoesWhatTheFitDid) {
  PointCloud source = Tube(24, 15);
  PointCloud target = Tube(24, 15);
  for (Eigen::Vector3d& p : source.points) p.x() *= 3e-12;
  for (Eigen::Vector3d& p : target.points) {
    p = Eigen::Vector3d(3e-12 * p.x() + 0.02 * std::sin(20.0 * p.z()), p.y(), 1.05 * p.z());
  }
  const FitResult result = FitTo(source, target);
  PointCloud applied = source;
  ASSERT_TRUE(ApplyWarp(result.warp, &applied).ok());
  double largest = 0.0;
  for (std::size_t p = 0; p < applied.size(); ++p) {
    largest = std::max(largest, (applied.points[p] - result.points[p]).norm());
  }
  EXPECT_LT(largest, 1e-6 * Diagonal(target.points));
}

}  // namespace
}  // namespace ceres_ed
