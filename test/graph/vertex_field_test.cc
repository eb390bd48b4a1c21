#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/graph/vertex_field.h>
#include <ceres_ed/graph/warp.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// Returns a linear displacement of a grid of spacing 0.25 in the plane z = 0.
VertexField MakeField() {
  VertexField field;
  field.points = MakeGridMesh(9, 9, 0.25).points;
  for (const Eigen::Vector3d& p : field.points) {
    field.displacements.emplace_back(0.1, 0.2 * p.x(), -0.1 * p.y());
  }
  return field;
}

// Returns a warp with one node at rest, so that only its finish has an effect.
Warp MakeWarp() {
  Warp warp;
  warp.graph.AddNode({1, 1, 0});
  warp.state.Resize(1);
  warp.finish = MakeField();
  return warp;
}

TEST(EvaluateField, GivesTheFieldsOwnPointsTheirDisplacementsInAnyOrder) {
  const VertexField field = MakeField();
  EXPECT_EQ(EvaluateField(field, field.points), field.displacements);
  std::vector<Eigen::Vector3d> queries = field.points;
  std::reverse(queries.begin(), queries.end());
  std::vector<Eigen::Vector3d> values = EvaluateField(field, queries, 2);
  std::reverse(values.begin(), values.end());
  EXPECT_EQ(values, field.displacements);
}

TEST(EvaluateField, IsTheMeanInTheMiddleOfACell) {
  const VertexField field = MakeField();
  // All four corners are equally near.
  const Eigen::Vector3d middle(0.625, 1.125, 0.0);
  const Eigen::Vector3d expected(0.1, 0.2 * middle.x(), -0.1 * middle.y());
  EXPECT_LT((EvaluateField(field, {middle})[0] - expected).norm(), 1e-15);
}

TEST(EvaluateField, StaysWithinTheFieldsAndFadesToNothing) {
  const VertexField field = MakeField();
  const double spacing = 0.25;
  const Eigen::Vector3d near(1.0, 1.0, 1.9 * spacing);
  EXPECT_GT(EvaluateField(field, {near})[0].norm(), 0.2);
  double last = 1.0;
  for (double height = 2.0; height < 6.0; height += 0.25) {
    const double length = EvaluateField(field, {{1.0, 1.0, height * spacing}})[0].norm();
    EXPECT_LT(length, last);
    last = length;
  }
  EXPECT_EQ(EvaluateField(field, {{1.0, 1.0, 6.0 * spacing}})[0].norm(), 0.0);
}

TEST(EvaluateField, TakesWeldedPointsAsOne) {
  const VertexField field = MakeField();
  VertexField doubled = field;
  for (int copy = 0; copy < 5; ++copy) {
    doubled.points.insert(doubled.points.end(), field.points.begin(), field.points.end());
    doubled.displacements.insert(
        doubled.displacements.end(), field.displacements.begin(), field.displacements.end());
  }
  const std::vector<Eigen::Vector3d> queries = {{0.3, 0.4, 0.1}, {1.7, 0.9, 0.0}};
  EXPECT_EQ(EvaluateField(doubled, queries), EvaluateField(field, queries));
}

TEST(EvaluateField, OfNothingIsZero) { EXPECT_EQ(EvaluateField({}, {{1, 2, 3}})[0].norm(), 0.0); }

TEST(ApplyWarp, AddsTheFinishBeforeTheSimilarity) {
  Warp warp = MakeWarp();
  warp.target_from_source.scale = 3.0;
  warp.target_from_source.rotation = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  warp.target_from_source.translation = {5, 6, 7};
  PointCloud cloud = MakeGridMesh(9, 9, 0.25);
  const PointCloud rest = cloud;
  ASSERT_TRUE(ApplyWarp(warp, &cloud).ok());
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    const Eigen::Vector3d moved = rest.points[p] + warp.finish.displacements[p];
    const Eigen::Vector3d expected(-3 * moved.y() + 5, 3 * moved.x() + 6, 3 * moved.z() + 7);
    EXPECT_LT((cloud.points[p] - expected).norm(), 1e-13);
  }
}

TEST(ApplyWarp, TurnsTheNormalsOfAMeshWithTheFinish) {
  Warp warp = MakeWarp();
  // z = x: the finish tilts the sheet by 45 degrees.
  for (std::size_t p = 0; p < warp.finish.points.size(); ++p) {
    warp.finish.displacements[p] = {0.0, 0.0, warp.finish.points[p].x()};
  }
  PointCloud cloud = MakeGridMesh(9, 9, 0.25);
  cloud.normals = ComputeVertexNormals(cloud);
  const double up = cloud.normals[0].z();
  ASSERT_TRUE(ApplyWarp(warp, &cloud).ok());
  const Eigen::Vector3d expected = up * Eigen::Vector3d(-1, 0, 1).normalized();
  for (const Eigen::Vector3d& normal : cloud.normals) EXPECT_LT((normal - expected).norm(), 1e-12);
}

TEST(ApplyWarp, TakesADenserMeshAlongWithTheFinish) {
  const Warp warp = MakeWarp();
  PointCloud dense = MakeGridMesh(17, 17, 0.125);
  const PointCloud rest = dense;
  ASSERT_TRUE(ApplyWarp(warp, &dense).ok());
  for (std::size_t p = 0; p < dense.size(); ++p) {
    const Eigen::Vector3d& at = rest.points[p];
    const Eigen::Vector3d expected(0.1, 0.2 * at.x(), -0.1 * at.y());
    // The result is a mean over points up to 0.28 away, and the slope of the field is 0.22.
    EXPECT_LT((dense.points[p] - at - expected).norm(), 0.28 * 0.23);
  }
}

TEST(ApplyWarp, RefusesAFinishWhosePartsDiffer) {
  Warp warp = MakeWarp();
  warp.finish.displacements.pop_back();
  PointCloud cloud = MakeGridMesh(3, 3, 0.25);
  const Status status = ApplyWarp(warp, &cloud);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.message().find("81 points, but 80"), std::string::npos) << status.message();
}

}  // namespace
}  // namespace ceres_ed
