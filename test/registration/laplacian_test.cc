#include <ceres_ed/registration/intrinsic/eigenfunctions.h>
#include <ceres_ed/registration/intrinsic/laplacian.h>
#include <ceres_ed/registration/intrinsic/tangent_triangles.h>

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// Returns `count` points of the unit sphere that are about evenly spread, on a spiral.
std::vector<Eigen::Vector3d> SpherePoints(int count) {
  const double golden = M_PI * (3.0 - std::sqrt(5.0));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count;
    const double r = std::sqrt(1.0 - z * z);
    points.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
  }
  return points;
}

// Expects the eigenvalues l (l + 1), each 2 l + 1 times, on a sphere of area 1 (times 4 pi).
void ExpectHarmonicsOfSphere(const SpectralBasis& basis, double tolerance) {
  ASSERT_EQ(basis.size(), 16);
  int k = 0;
  for (int l = 0; l <= 3; ++l) {
    for (int m = -l; m <= l; ++m, ++k) {
      const double expected = 4.0 * M_PI * l * (l + 1);
      EXPECT_NEAR(basis.eigenvalues[k], expected, tolerance * expected + 1e-6) << "l = " << l;
    }
  }
}

TEST(Laplacian, HasTheEigenvaluesOfTheSphere) {
  const PointCloud sphere = MakeSphereMesh(4);
  const Laplacian laplacian = BuildLaplacian(sphere.points, sphere.triangles);
  EXPECT_NEAR(laplacian.mass.sum(), 4.0 * M_PI, 0.02);
  const auto basis = ComputeEigenfunctions(laplacian, 16);
  ASSERT_TRUE(basis.has_value());
  ExpectHarmonicsOfSphere(*basis, 0.01);
}

TEST(Laplacian, HasTheEigenvaluesOfASquareWithFreeSides) {
  const PointCloud square = MakeGridMesh(41, 41, 0.25);
  const auto basis = ComputeEigenfunctions(BuildLaplacian(square.points, square.triangles), 9);
  ASSERT_TRUE(basis.has_value());
  const int sums_of_squares[] = {0, 1, 1, 2, 4, 4, 5, 5, 8};
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(basis->eigenvalues[k],
                M_PI * M_PI * sums_of_squares[k],
                0.02 * M_PI * M_PI * sums_of_squares[k] + 1e-6);
  }
}

TEST(Laplacian, OfBarePointsIsThatOfTheirSurface) {
  const std::vector<Eigen::Vector3d> points = SpherePoints(1500);
  const double spacing = std::sqrt(4.0 * M_PI / 1500);
  for (const bool oriented : {true, false}) {
    const auto triangles = TangentTriangles(points, points, oriented, spacing);
    // Euler: 2 V - 4 triangles, each once for each of its corners.
    EXPECT_NEAR(static_cast<double>(triangles.size()), 3.0 * (2 * 1500 - 4), 30.0);
    const Laplacian laplacian = BuildLaplacian(points, triangles, 1.0 / 3.0);
    EXPECT_NEAR(laplacian.mass.sum(), 4.0 * M_PI, 0.1);
    const auto basis = ComputeEigenfunctions(laplacian, 16);
    ASSERT_TRUE(basis.has_value());
    ExpectHarmonicsOfSphere(*basis, 0.02);
  }
}

TEST(TangentTriangles, KeepTheSheetsOfAThinBodyApart) {
  // Two parallel sheets, nearer to each other than their points are, which look to opposite sides.
  const PointCloud sheet = MakeGridMesh(12, 12);
  std::vector<Eigen::Vector3d> points = sheet.points;
  for (const Eigen::Vector3d& point : sheet.points) {
    points.push_back(point - Eigen::Vector3d(0.1, 0.2, 0.5));
  }
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::UnitZ());
  std::fill(normals.begin() + 144, normals.end(), -Eigen::Vector3d::UnitZ());
  int between = 0;
  const auto triangles = TangentTriangles(points, normals, /*oriented=*/true, 1.0);
  EXPECT_GT(triangles.size(), 1000u);
  for (const auto& [a, b, c] : triangles)
    between += (a < 144) != (b < 144) || (b < 144) != (c < 144);
  EXPECT_EQ(between, 0);
}

TEST(Eigenfunctions, AreOrthonormalAndDoNotDependOnUnits) {
  PointCloud sphere = MakeSphereMesh(3);
  Jitter(0.03, 5, &sphere);
  const auto basis = ComputeEigenfunctions(BuildLaplacian(sphere.points, sphere.triangles), 20);
  ASSERT_TRUE(basis.has_value());
  const Eigen::MatrixXd gram =
      basis->functions.transpose() * basis->mass.asDiagonal() * basis->functions;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(20, 20)).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((basis->functions.col(0).array() - 1.0).abs().maxCoeff(), 1e-6);
  for (Eigen::Vector3d& point : sphere.points) point *= 1000.0;
  const auto scaled = ComputeEigenfunctions(BuildLaplacian(sphere.points, sphere.triangles), 20);
  ASSERT_TRUE(scaled.has_value());
  EXPECT_LT((scaled->eigenvalues - basis->eigenvalues).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Eigenfunctions, AreNothingOnTooFewVertices) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_FALSE(ComputeEigenfunctions(BuildLaplacian(points, {{0, 1, 2}}), 10).has_value());
}

}  // namespace
}  // namespace ceres_ed
