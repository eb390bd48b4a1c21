#include <ceres_ed/registration/finish/fold_guard.h>

#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

class FoldGuard : public ::testing::Test {
 protected:
  // Returns the number of triangles whose normal does not point up.
  int NumDown(const std::vector<Eigen::Vector3d>& points) const {
    int down = 0;
    for (const auto& t : mesh_.triangles) {
      const Eigen::Vector3d area = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
      down += area.z() <= 0.0 ? 1 : 0;
    }
    return down;
  }

  const PointCloud cloud_ = MakeGridMesh(9, 9, 1.0);
  const WeldedMesh mesh_ = BuildWeldedMesh(cloud_, BuildTopology(cloud_));
  const std::vector<Eigen::Vector3d> start_ = cloud_.points;
  const std::vector<Eigen::Vector3d> up_ =
      std::vector<Eigen::Vector3d>(start_.size(), Eigen::Vector3d::UnitZ());
};

TEST_F(FoldGuard, LeavesAHarmlessDisplacementAlone) {
  std::vector<Eigen::Vector3d> points = start_;
  for (Eigen::Vector3d& point : points) point += Eigen::Vector3d(0.3 * point.y(), 0.1, point.x());
  const std::vector<Eigen::Vector3d> wanted = points;
  EXPECT_EQ(DampFolds(mesh_, start_, up_, &points), 0);
  EXPECT_EQ(points, wanted);
}

TEST_F(FoldGuard, LeavesNoTriangleTurnedOver) {
  std::vector<Eigen::Vector3d> points = start_;
  points[40].x() += 2.5;
  points[22] = points[20];
  points[60].y() -= 100.0;
  ASSERT_GT(NumDown(points), 3);
  EXPECT_GT(DampFolds(mesh_, start_, up_, &points), 2);
  EXPECT_EQ(NumDown(points), 0);
  // Far away nothing changes.
  EXPECT_EQ(points[8], start_[8]);
}

TEST_F(FoldGuard, LetsATriangleThatIsFoldedTurn) {
  std::vector<Eigen::Vector3d> folded = start_;
  folded[40].x() += 1.5;
  ASSERT_GT(NumDown(folded), 0);
  std::vector<Eigen::Vector3d> points = start_;
  DampFolds(mesh_, folded, up_, &points);
  EXPECT_EQ(NumDown(points), 0);
}

}  // namespace
}  // namespace ceres_ed
