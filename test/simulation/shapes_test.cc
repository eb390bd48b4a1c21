#include "ceres_ed/simulation/shapes.h"

#include <ceres_ed/simulation/meshing.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Returns how many triangles use each edge in each direction.
std::map<std::pair<int, int>, int> DirectedEdges(const PointCloud& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  return edges;
}

double Volume(const PointCloud& mesh) {
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6.0;
  }
  return volume;
}

double SmallestAngleDeg(const PointCloud& mesh) {
  double smallest = 180.0;
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& corner = mesh.points[t[k]];
      const Eigen::Vector3d a = mesh.points[t[(k + 1) % 3]] - corner;
      const Eigen::Vector3d b = mesh.points[t[(k + 2) % 3]] - corner;
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / kPi);
    }
  }
  return smallest;
}

std::size_t DistinctPoints(const PointCloud& mesh) {
  std::set<std::tuple<double, double, double>> points;
  for (const Eigen::Vector3d& p : mesh.points) points.emplace(p.x(), p.y(), p.z());
  return points.size();
}

void ExpectClosedManifoldSphere(const PointCloud& mesh) {
  const auto edges = DirectedEdges(mesh);
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << edge.first << "-" << edge.second;
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1u) << edge.first << "-" << edge.second;
  }
  const int num_edges = static_cast<int>(edges.size()) / 2;
  EXPECT_EQ(static_cast<int>(mesh.size()) - num_edges + static_cast<int>(mesh.triangles.size()), 2);
}

class SyntheticBody : public testing::TestWithParam<SyntheticShape> {};

TEST_P(SyntheticBody, IsAClosedOutwardManifoldOfGoodTriangles) {
  for (const int vertices : {800, 2500}) {
    const PointCloud mesh = MakeSyntheticShape(GetParam(), vertices, 1.0);
    EXPECT_NEAR(static_cast<double>(mesh.size()), vertices, 0.1 * vertices);
    ExpectClosedManifoldSphere(mesh);
    EXPECT_EQ(DistinctPoints(mesh), mesh.size());
    EXPECT_GT(Volume(mesh), 0.0);
    // The remeshing of Botsch and Kobbelt keeps angles above 30 degrees, except for thin fins at
    // low vertex counts.
    EXPECT_GT(SmallestAngleDeg(mesh), vertices < 1000 ? 15.0 : 30.0);
  }
}

TEST_P(SyntheticBody, LiesOnItsSurfaceAndScalesWithItsSize) {
  const PointCloud mesh = MakeSyntheticShape(GetParam(), 800, 0.25);
  const SyntheticSolid solid = MakeSyntheticSolid(GetParam());
  Eigen::AlignedBox3d box;
  double worst = 0.0;
  for (const Eigen::Vector3d& point : mesh.points) {
    worst = std::max(worst, std::abs(solid.Value(point / 0.25)));
    box.extend(point);
  }
  EXPECT_LT(worst, 1e-4);
  EXPECT_NEAR(box.sizes().maxCoeff(), 0.25, 0.04);
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         SyntheticBody,
                         testing::Values(SyntheticShape::kDolphin,
                                         SyntheticShape::kHeart,
                                         SyntheticShape::kKidney,
                                         SyntheticShape::kStomach),
                         [](const auto& info) {
                           return std::string(SyntheticShapeName(info.param));
                         });

TEST(SyntheticShapes, TheSameArgumentsGiveTheSameMesh) {
  const PointCloud first = MakeSyntheticShape(SyntheticShape::kKidney, 700, 0.1);
  const PointCloud second = MakeSyntheticShape(SyntheticShape::kKidney, 700, 0.1);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.triangles, second.triangles);
}

TEST(SyntheticShapes, ThePlaneIsASquareThatFacesUp) {
  const PointCloud mesh = MakeSyntheticShape(SyntheticShape::kPlane, 900, 0.2);
  EXPECT_EQ(mesh.size(), 900u);
  EXPECT_EQ(DistinctPoints(mesh), mesh.size());
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.points[t[0]];
    const Eigen::Vector3d twice = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
    EXPECT_GT(twice.z(), 0.0);
    area += 0.5 * twice.z();
  }
  EXPECT_NEAR(area, 0.04, 1e-12);
  int borders = 0;
  const auto edges = DirectedEdges(mesh);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    borders += edges.count({edge.second, edge.first}) == 0;
  }
  EXPECT_EQ(borders, 4 * 29);
}

TEST(SyntheticShapes, NamesAreReadBack) {
  for (const SyntheticShape shape : AllSyntheticShapes()) {
    EXPECT_EQ(SyntheticShapeFromName(SyntheticShapeName(shape)), shape);
  }
  EXPECT_FALSE(SyntheticShapeFromName("liver").has_value());
}

TEST(SyntheticSolid, OneBallIsASphereAndAFlattenedOneAnEllipsoid) {
  SyntheticSolid solid(0.01);
  solid.Add({{{0.1, 0.2, 0.3, 0.5}}, Eigen::Vector3d::UnitZ(), 0.4});
  const Eigen::Vector3d center(0.1, 0.2, 0.3);
  EXPECT_NEAR(solid.Value(center + Eigen::Vector3d(0.5, 0, 0)), 0.0, 1e-12);
  EXPECT_NEAR(solid.Value(center + Eigen::Vector3d(0, 0, 0.2)), 0.0, 1e-12);
  EXPECT_NEAR(solid.Value(center + Eigen::Vector3d(0, 0, 0.25)), 0.05, 1e-12);
  EXPECT_LT(solid.Value(center + Eigen::Vector3d(0, 0.3, 0.1)), 0.0);
}

TEST(SyntheticMeshing, TheVolumeOfAMeshedBallIsThatOfTheBall) {
  SyntheticSolid solid(0.01);
  solid.Add({{{0.0, 0.0, 0.0, 0.5}}, Eigen::Vector3d::UnitZ(), 1.0});
  const PointCloud mesh = RemeshUniformly(MarchTetrahedra(solid, 0.04), solid, 1500);
  ExpectClosedManifoldSphere(mesh);
  // A polyhedron in the ball with 3000 faces has less volume than the ball by about 2 pi / (sqrt(3)
  // n) = 0.24 %.
  const double ball = 4.0 / 3.0 * kPi * 0.125;
  EXPECT_LT(Volume(mesh), ball);
  EXPECT_NEAR(Volume(mesh), ball, 0.005 * ball);
}

}  // namespace
}  // namespace ceres_ed
