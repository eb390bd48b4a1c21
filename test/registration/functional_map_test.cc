#include <ceres_ed/registration/intrinsic/functional_map.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// Returns a body without symmetries: a sphere with three unequal bumps.
PointCloud MakePotato() {
  PointCloud potato = MakeSphereMesh(3);
  const Eigen::Vector3d centers[] = {{1, 0, 0}, {0, 0.8, 0.6}, {-0.5, -0.5, 0.7}};
  const double heights[] = {0.7, 0.5, 0.3};
  for (Eigen::Vector3d& point : potato.points) {
    double radius = 1.0;
    for (int i = 0; i < 3; ++i) {
      radius += heights[i] * std::exp(-4.0 * (point - centers[i].normalized()).squaredNorm());
    }
    point *= radius;
  }
  return potato;
}

SpectralBasis BasisOf(const PointCloud& mesh, int count) {
  return *ComputeEigenfunctions(BuildLaplacian(mesh.points, mesh.triangles), count);
}

std::vector<int> Range(int count) {
  std::vector<int> range(count);
  std::iota(range.begin(), range.end(), 0);
  return range;
}

TEST(NearestRows, AreThoseOfASearchOneByOne) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const int columns : {1, 5, 30}) {
    const Eigen::MatrixXd a =
        Eigen::MatrixXd::NullaryExpr(53, columns, [&] { return uniform(random); });
    const Eigen::MatrixXd b =
        Eigen::MatrixXd::NullaryExpr(37, columns, [&] { return uniform(random); });
    const PointMap map = NearestRows(a, b);
    ASSERT_EQ(map.forth.size(), 53u);
    ASSERT_EQ(map.back.size(), 37u);
    const auto expect_nearest = [](const auto& row, const Eigen::MatrixXd& among, int found) {
      const double least = (among.rowwise() - row).rowwise().norm().minCoeff();
      EXPECT_NEAR((among.row(found) - row).norm(), least, 1e-5);
    };
    for (int i = 0; i < 53; ++i) expect_nearest(a.row(i), b, map.forth[i]);
    for (int j = 0; j < 37; ++j) expect_nearest(b.row(j), a, map.back[j]);
  }
  const PointMap tie = NearestRows(Eigen::MatrixXd::Zero(20, 2), Eigen::MatrixXd::Ones(40, 2));
  EXPECT_EQ(tie.forth, Images(20, 0));
  EXPECT_EQ(tie.back, Images(40, 0));
}

TEST(FunctionalMap, OfACopyIsDiagonal) {
  const PointCloud potato = MakePotato();
  PointCloud turned = potato;
  const Eigen::AngleAxisd turn(2.0, Eigen::Vector3d(1, -2, 3).normalized());
  for (Eigen::Vector3d& point : turned.points) point = 3.0 * (turn * point) + point.Ones();
  const SpectralBasis source = BasisOf(potato, 12);
  const SpectralBasis target = BasisOf(turned, 12);
  const int n = static_cast<int>(potato.size());
  const SpectralPair pair = {&source, &target, Range(n), Range(n)};
  const Eigen::MatrixXd C = FunctionalMap(pair, {Range(n), Range(n)}, 12);
  EXPECT_LT((C.cwiseAbs() - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_EQ(PointMapOf(pair, C).forth, Range(n));
}

TEST(ZoomOut, MakesTheIdentityOfAMapThatIsRoughlyRight) {
  const PointCloud potato = MakePotato();
  const SpectralBasis basis = BasisOf(potato, 40);
  const int n = static_cast<int>(potato.size());
  const SpectralPair pair = {&basis, &basis, Range(n), Range(n)};
  // Each vertex is sent to some vertex near it.
  std::mt19937 random(9);
  PointMap rough = {Range(n), Range(n)};
  for (Images* images : {&rough.forth, &rough.back}) {
    for (int i = 0; i < n; ++i) {
      int found = i;
      do {
        found = static_cast<int>(random() % n);
      } while ((potato.points[found] - potato.points[i]).norm() > 0.6);
      (*images)[i] = found;
    }
  }
  const PointMap fine = ZoomOut(pair, rough, 4, 40, 2);
  int exact = 0;
  for (int i = 0; i < n; ++i) exact += fine.forth[i] == i;
  EXPECT_GT(exact, 0.95 * n);
}

}  // namespace
}  // namespace ceres_ed
