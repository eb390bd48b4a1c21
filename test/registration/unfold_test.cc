#include <ceres_ed/registration/finish/folded_faces.h>
#include <ceres_ed/registration/finish/unfold.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// Returns the rotations computed by SVD, with every edge of the triangles used once.
std::vector<Eigen::Matrix3d> RotationsBySvd(const WeldedMesh& mesh,
                                            const Points& rest,
                                            const Points& points) {
  std::set<std::pair<int, int>> edges;
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::vector<Eigen::Matrix3d> rotations(rest.size(), Eigen::Matrix3d::Zero());
  for (const auto& [a, b] : edges) {
    const Eigen::Matrix3d product = (points[b] - points[a]) * (rest[b] - rest[a]).transpose();
    rotations[a] += product;
    rotations[b] += product;
  }
  for (Eigen::Matrix3d& R : rotations) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d sign(1, 1, (svd.matrixU() * svd.matrixV()).determinant() < 0.0 ? -1 : 1);
    R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  }
  return rotations;
}

// Returns the faces that are turned over, and those below 5 % of their area unless their
// surroundings are, too.
std::vector<int> FoldedByBruteForce(const WeldedMesh& mesh,
                                    const Points& rest,
                                    const Points& points) {
  const std::vector<Eigen::Matrix3d> R = RotationsBySvd(mesh, rest, points);
  const auto area = [](const std::array<int, 3>& t, const Points& p) -> Eigen::Vector3d {
    return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
  };
  std::vector<int> folded;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    double now = 0.0;
    double before = 0.0;
    for (const int corner : t) {
      for (std::size_t g = 0; g < mesh.triangles.size(); ++g) {
        const auto& u = mesh.triangles[g];
        if (g == f || std::find(u.begin(), u.end(), corner) == u.end()) continue;
        now += area(u, points).norm();
        before += area(u, rest).norm();
      }
    }
    const Eigen::Vector3d n = (R[t[0]] + R[t[1]] + R[t[2]]) * area(t, rest);
    const bool is_squeezed =
        area(t, points).norm() < 0.05 * area(t, rest).norm() && now > 0.2 * before;
    if (n.dot(area(t, points)) < 0.0 || is_squeezed) folded.push_back(static_cast<int>(f));
  }
  return folded;
}

// A sphere that is rotated and stretched, and the same sphere with a crumpled patch.
class Unfold : public ::testing::Test {
 protected:
  Unfold() {
    const Eigen::AngleAxisd turn(2.0, Eigen::Vector3d(1, 2, 3).normalized());
    for (const Eigen::Vector3d& point : rest_) {
      truth_.push_back(turn * Eigen::Vector3d(1.2 * point.x(), point.y(), 0.9 * point.z()));
    }
    folded_ = truth_;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-0.15, 0.15);
    for (std::size_t v = 0; v < rest_.size(); ++v) {
      const Eigen::Vector3d shift(uniform(random), uniform(random), uniform(random));
      if (rest_[v].z() > 0.96) folded_[v] += shift;
    }
    input_.mesh = &mesh_;
    input_.rest = &rest_;
  }

  int NumFolded(const Points& points) const {
    return static_cast<int>(FoldedByBruteForce(mesh_, rest_, points).size());
  }

  const Surface surface_{MakeSphereMesh(4)};
  const WeldedMesh mesh_ = BuildWeldedMesh(surface_.cloud(), surface_.topology());
  const Points rest_ = surface_.cloud().points;
  Points truth_;
  Points folded_;
  UnfoldInput input_;
};

TEST(NearestRotation, IsThatOfTheSvd) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 1000; ++k) {
    Eigen::Matrix3d B = Eigen::Matrix3d::NullaryExpr([&] { return normal(random); });
    if (k % 3 == 0) B.col(2).setZero();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(B, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector3d sign(1, 1, svd.matrixU().determinant() * svd.matrixV().determinant());
    const Eigen::Matrix3d R = NearestRotation(B);
    // The maximum itself is compared, because the rotation is ill-conditioned where singular values
    // cancel.
    EXPECT_NEAR((R.transpose() * B).trace(), sign.dot(svd.singularValues()), 1e-9) << k;
    EXPECT_NEAR((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-6) << k;
    EXPECT_NEAR(R.determinant(), 1.0, 1e-6) << k;
  }
}

TEST_F(Unfold, FindsWhatBruteForceFinds) {
  ASSERT_GT(NumFolded(folded_), 20);
  EXPECT_EQ(FoldFinder(mesh_, rest_).FindAll(folded_), FoldedByBruteForce(mesh_, rest_, folded_));
  // The face is squeezed flat, but its normal is not reversed.
  Points squeezed = truth_;
  const auto& t = mesh_.triangles[100];
  squeezed[t[0]] = 0.49 * squeezed[t[1]] + 0.49 * squeezed[t[2]] + 0.02 * squeezed[t[0]];
  ASSERT_GT(NumFolded(squeezed), 0);
  EXPECT_EQ(FoldFinder(mesh_, rest_).FindAll(squeezed), FoldedByBruteForce(mesh_, rest_, squeezed));
}

TEST_F(Unfold, LeavesNoFoldAndComesNearTheTruth) {
  for (const bool with_target : {false, true}) {
    PointCloud cloud = surface_.cloud();
    cloud.points = truth_;
    cloud.normals.clear();
    const Surface target(cloud);
    if (with_target) input_.target = &target;
    Points points = folded_;
    const UnfoldResult result = UnfoldFaces(input_, &points);
    EXPECT_EQ(result.before, NumFolded(folded_));
    EXPECT_EQ(result.after, 0);
    EXPECT_EQ(NumFolded(points), 0);
    double before = 0.0;
    double after = 0.0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      before += (folded_[v] - truth_[v]).norm();
      after += (points[v] - truth_[v]).norm();
    }
    // The comparison is in the mean: parts that are crumpled but not folded do not change.
    EXPECT_LT(after, 0.5 * before) << with_target;
  }
}

TEST_F(Unfold, MovesNothingWhereNothingIsFolded) {
  Points points = truth_;
  EXPECT_EQ(UnfoldFaces(input_, &points).before, 0);
  EXPECT_EQ(points, truth_);
  points = folded_;
  UnfoldFaces(input_, &points);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (rest_[v].z() < 0.0) {
      EXPECT_EQ(points[v], folded_[v]) << v;
    }
  }
}

TEST_F(Unfold, HoldsWhatIsHeld) {
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    if (rest_[v].z() > 0.99) input_.held.push_back(static_cast<int>(v));
  }
  ASSERT_FALSE(input_.held.empty());
  Points points = folded_;
  const UnfoldResult result = UnfoldFaces(input_, &points);
  EXPECT_EQ(result.after, NumFolded(points));
  EXPECT_LT(result.after, result.before);
  for (const int v : input_.held) EXPECT_EQ(points[v], folded_[v]) << v;
}

TEST_F(Unfold, GivesTheSameBitsAgain) {
  Points first = folded_;
  Points second = folded_;
  UnfoldFaces(input_, &first);
  UnfoldFaces(input_, &second);
  EXPECT_EQ(first, second);
}

TEST_F(Unfold, UnfoldsAPieceThatIsAllFolded) {
  // Two triangles, one folded onto the other, without anything around that holds them.
  const Surface pair(MakeGridMesh(2, 2));
  const WeldedMesh mesh = BuildWeldedMesh(pair.cloud(), pair.topology());
  const Points rest = pair.cloud().points;
  Points points = rest;
  points[0] = rest[3] + Eigen::Vector3d(0.1, 0.2, 0.0);
  input_.mesh = &mesh;
  input_.rest = &rest;
  const int before = static_cast<int>(FoldedByBruteForce(mesh, rest, points).size());
  const UnfoldResult result = UnfoldFaces(input_, &points);
  EXPECT_EQ(result.before, before);
  EXPECT_EQ(result.after, 0);
  for (const Eigen::Vector3d& point : points) EXPECT_LT(point.norm(), 3.0);
}

TEST_F(Unfold, HasNothingToDoWithBarePoints) {
  PointCloud bare = surface_.cloud();
  bare.triangles.clear();
  const WeldedMesh mesh = BuildWeldedMesh(bare, BuildTopology(bare));
  input_.mesh = &mesh;
  Points points = folded_;
  EXPECT_EQ(UnfoldFaces(input_, &points).before, 0);
  EXPECT_EQ(points, folded_);
}

}  // namespace
}  // namespace ceres_ed
