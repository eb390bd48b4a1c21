#include "ceres_ed/simulation/deformations.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

class SyntheticDeformation : public testing::TestWithParam<SyntheticShape> {
 protected:
  static constexpr double kSize = 0.1;
  const PointCloud& rest_ = Rest(GetParam());

  // Meshing takes longer than any of these tests, so each shape is meshed once.
  static const PointCloud& Rest(SyntheticShape shape) {
    static auto* const shapes = new std::map<SyntheticShape, PointCloud>();
    const auto [entry, is_new] = shapes->try_emplace(shape);
    if (is_new) entry->second = MakeSyntheticShape(shape, 1200, kSize);
    return entry->second;
  }

  Eigen::Vector3d Deform(double phase, const Eigen::Vector3d& point) const {
    return DeformSyntheticPoint(GetParam(), kSize, phase, point);
  }

  Eigen::Matrix3d Jacobian(double phase, const Eigen::Vector3d& point, double step) const {
    Eigen::Matrix3d jacobian;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d h = step * kSize * Eigen::Vector3d::Unit(k);
      jacobian.col(k) =
          (Deform(phase, point + h) - Deform(phase, point - h)) / (2.0 * step * kSize);
    }
    return jacobian;
  }
};

TEST_P(SyntheticDeformation, PhaseZeroIsTheIdentity) {
  for (const Eigen::Vector3d& point : rest_.points) {
    EXPECT_LT((Deform(0.0, point) - point).norm(), 1e-12 * kSize);
  }
}

TEST_P(SyntheticDeformation, TinyPhaseMovesTinyDistances) {
  for (const double phase : {1e-17, 1e-12, 1e-8, 2e-7, 3e-7}) {
    for (const Eigen::Vector3d& point : rest_.points) {
      // No point moves farther than about the size of the body at phase 1.
      EXPECT_LT((Deform(phase, point) - point).norm(), (2.0 * phase + 1e-8) * kSize) << phase;
    }
  }
}

TEST_P(SyntheticDeformation, NeverFoldsOnOrInsideTheBody) {
  for (const double phase : {0.5, 1.0}) {
    double least = 1e30;
    for (const Eigen::Vector3d& point : rest_.points) {
      least = std::min(least, Jacobian(phase, point, 1e-5).determinant());
      least = std::min(least, Jacobian(phase, 0.7 * point, 1e-5).determinant());
    }
    EXPECT_GT(least, 0.3) << "phase " << phase;
  }
}

TEST_P(SyntheticDeformation, HasAContinuousJacobian) {
  // The largest second derivative is about 60 per unit (in the bends), which over 2e-4 gives 0.012.
  // A jump of the Jacobian would not shrink with the step.
  for (const Eigen::Vector3d& point : rest_.points) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d h = 1e-4 * kSize * Eigen::Vector3d::Unit(k);
      const Eigen::Matrix3d jump = Jacobian(1.0, point + h, 1e-5) - Jacobian(1.0, point - h, 1e-5);
      ASSERT_LT(jump.cwiseAbs().maxCoeff(), 0.015) << point.transpose();
    }
  }
}

TEST_P(SyntheticDeformation, KeepsEdgesWithinAQuarterAndMovesVisibly) {
  const PointCloud deformed = DeformSyntheticShape(GetParam(), kSize, 1.0, rest_);
  ASSERT_EQ(deformed.triangles, rest_.triangles);
  std::vector<double> ratios;
  for (const auto& t : rest_.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      ratios.push_back((deformed.points[a] - deformed.points[b]).norm() /
                       (rest_.points[a] - rest_.points[b]).norm());
    }
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_GT(ratios[ratios.size() / 100], 0.78);
  EXPECT_LT(ratios[ratios.size() - 1 - ratios.size() / 100], 1.25);
  EXPECT_GT(ratios.front(), 0.7);
  EXPECT_LT(ratios.back(), 1.35);
  double largest = 0.0;
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    largest = std::max(largest, (deformed.points[k] - rest_.points[k]).norm());
  }
  EXPECT_GT(largest / Diagonal(rest_.points), 0.03);
}

TEST_P(SyntheticDeformation, ScalesWithTheSize) {
  for (const Eigen::Vector3d& point : rest_.points) {
    EXPECT_LT((DeformSyntheticPoint(GetParam(), 10.0 * kSize, 0.7, 10.0 * point) -
               10.0 * Deform(0.7, point))
                  .norm(),
              1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         SyntheticDeformation,
                         testing::ValuesIn(AllSyntheticShapes()),
                         [](const auto& info) {
                           return std::string(SyntheticShapeName(info.param));
                         });

TEST(SyntheticDeformations, TheTrunkOfTheDolphinIsHeldWhileTheFlukeMovesFar) {
  const Eigen::Vector3d trunk(0.15, 0.05, -0.02);
  EXPECT_EQ(DeformSyntheticPoint(SyntheticShape::kDolphin, 1.0, 1.0, trunk), trunk);
  const Eigen::Vector3d fluke(-0.55, 0.1, 0.016);
  EXPECT_GT((DeformSyntheticPoint(SyntheticShape::kDolphin, 1.0, 1.0, fluke) - fluke).norm(), 0.3);
}

TEST(SyntheticDeformations, TheArcOfTheKidneyKeepsTheLengthOfItsAxis) {
  // A point far behind the indentation, where its Gaussian is below 1e-9.
  const auto deform = [](double z) {
    return DeformSyntheticPoint(SyntheticShape::kKidney, 1.0, 1.0, {0.0, 1.0, z});
  };
  double length = 0.0;
  for (int k = 0; k < 2000; ++k) {
    length += (deform(-0.5 + (k + 1) / 2000.0) - deform(-0.5 + k / 2000.0)).norm();
  }
  EXPECT_NEAR(length, 1.0, 1e-6);
}

}  // namespace
}  // namespace ceres_ed
