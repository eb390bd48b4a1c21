#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/welded_mesh.h>
#include <ceres_ed/registration/finish/finish_matching.h>
#include <ceres_ed/registration/finish/vertex_finish.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/simulation/views.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// Returns a body with a diagonal near 1 and a bump of a few edges, which no graph of few nodes can
// represent.
PointCloud MakeBody(int vertices) {
  return MakeSyntheticShape(SyntheticShape::kKidney, vertices, 1.0);
}

PointCloud WithWaves(PointCloud cloud, double height) {
  for (Eigen::Vector3d& p : cloud.points) {
    p += height * Eigen::Vector3d(std::sin(20 * p.y()), std::sin(20 * p.z()), std::sin(20 * p.x()));
  }
  return cloud;
}

double MeanDistance(const std::vector<Eigen::Vector3d>& points, const Surface& surface) {
  double sum = 0.0;
  for (const Eigen::Vector3d& point : points) {
    sum += std::sqrt(surface.index().Closest(point).squared_distance);
  }
  return sum / static_cast<double>(points.size());
}

FinishInput InputOf(const Surface& source, const Surface& target) {
  FinishInput input;
  input.source = &source;
  input.points = &source.cloud().points;
  input.normals = &source.cloud().normals;
  input.target = &target;
  input.matching.resolution = 1e-4;
  return input;
}

TEST(FinishVertices, BringsASurfaceOntoItsTarget) {
  const Surface source(MakeBody(3000));
  // The surfaces are meshed separately, so that no vertex of one is a vertex of the other.
  const Surface target(WithWaves(MakeBody(4000), 0.005));
  const FinishResult result = FinishVertices(InputOf(source, target), {});
  EXPECT_TRUE(result.moved);
  const double before = MeanDistance(source.cloud().points, target);
  EXPECT_GT(before, 2e-3);
  EXPECT_LT(MeanDistance(result.points, target), 0.1 * before);
}

TEST(FinishVertices, MatchesNothingAfterAStop) {
  const Surface source(MakeBody(5000));
  const Surface target(MakeBody(6000));
  const WeldedMesh mesh = BuildWeldedMesh(source.cloud(), source.topology());
  std::vector<Eigen::Vector3d> points;
  for (const int point : mesh.point_of_vertex) points.push_back(source.cloud().points[point]);
  const FinishInput input = InputOf(source, target);
  FinishMatcher matcher(source, mesh, source.cloud().normals, target, input.matching);
  int polls = 0;
  EXPECT_FALSE(matcher
                   .Match(points,
                          3.0,
                          [&polls] {
                            ++polls;
                            return false;
                          })
                   .empty());
  // Each direction asks at its begin and on its way.
  EXPECT_GE(polls, 4);
  for (int last = 0; last < polls; ++last) {
    int asked = 0;
    EXPECT_TRUE(matcher.Match(points, 3.0, [&] { return asked++ == last; }).empty());
    EXPECT_EQ(asked, last + 1);
  }
}

TEST(FinishVertices, BringsBarePointsOntoTheirTarget) {
  PointCloud body = MakeBody(3000);
  body.triangles.clear();
  const Surface source(body);
  const Surface target(WithWaves(MakeBody(4000), 0.005));
  const FinishResult result = FinishVertices(InputOf(source, target), {});
  EXPECT_LT(MeanDistance(result.points, target), 0.2 * MeanDistance(source.cloud().points, target));
}

// The facets of a coarse mesh lie within the surface of its vertices. If vertices were attracted to
// the facets, they would attract the others beyond the surface.
TEST(FinishVertices, PutsTheVerticesOfACoarseMeshOnTheSurface) {
  PointCloud small = MakeSphereMesh(2);
  for (Eigen::Vector3d& point : small.points) point *= 0.97;
  for (const int levels : {1, 2, 4}) {
    const Surface source(small);
    const Surface target(MakeSphereMesh(levels));
    const FinishResult result = FinishVertices(InputOf(source, target), {});
    double mean = 0.0;
    for (const Eigen::Vector3d& point : result.points) {
      mean += point.norm() / static_cast<double>(result.points.size());
    }
    // The middle of a facet of the source is 1.3 % below the sphere, and that of the coarsest
    // target 5 %.
    EXPECT_NEAR(mean, 1.0, 0.003) << levels;
  }
}

TEST(FinishVertices, DoesNotTraceNoise) {
  const Surface source(MakeBody(3000));
  PointCloud noisy = MakeBody(8000);
  AddSyntheticNoise(0.005, 3, &noisy);
  const Surface target(noisy);
  FinishInput input = InputOf(source, target);
  input.noise = FinishNoise(source, target);
  EXPECT_NEAR(input.noise, 0.005, 0.001);
  const Surface truth(MakeBody(8000));
  const double before = MeanDistance(source.cloud().points, truth);
  EXPECT_LT(MeanDistance(FinishVertices(input, {}).points, truth), before + 0.1 * 0.005);
}

TEST(FinishNoise, IsNothingBetweenCleanSurfaces) {
  const Surface source(MakeBody(3000));
  const Surface target(MakeBody(3500));
  EXPECT_LT(FinishNoise(source, target), 1e-4);
}

TEST(FinishVertices, LeavesWhatIsFarFromTheTargetAlone) {
  const Surface source(MakeBody(6000));
  PointCloud body = WithWaves(MakeBody(4000), 0.005);
  // Only the upper half.
  std::vector<std::array<int, 3>> triangles;
  for (const auto& t : body.triangles) {
    const auto is_up = [&](int corner) { return body.points[corner].z() > 0.0; };
    if (std::all_of(t.begin(), t.end(), is_up)) triangles.push_back(t);
  }
  body.triangles = triangles;
  const Surface target(body);
  FinishInput input = InputOf(source, target);
  // Within the half, no point is farther away.
  input.matching.max_distance = 0.03;
  const FinishResult result = FinishVertices(input, {});
  double moved = 0.0;
  for (std::size_t p = 0; p < result.points.size(); ++p) {
    const Eigen::Vector3d& rest = source.cloud().points[p];
    const double way = (result.points[p] - rest).norm();
    EXPECT_LT(way, 0.02) << p;
    if (rest.z() > 0.05) moved = std::max(moved, way);
    if (rest.z() < -0.3) {
      EXPECT_LT(way, 1e-3) << p;
    }
  }
  EXPECT_GT(moved, 0.003);
}

TEST(FinishVertices, HoldsFixedPointsExactlyAndLandmarksNearly) {
  const Surface source(MakeBody(3000));
  const Surface target(WithWaves(MakeBody(4000), 0.005));
  FinishInput input = InputOf(source, target);
  const std::vector<Eigen::Vector3d>& rest = source.cloud().points;
  for (int p = 0; p + 50 < static_cast<int>(rest.size()); p += 100) {
    Correspondence hold;
    hold.point = p;
    hold.target = rest[p];
    input.fixed.push_back(hold);
    hold.point = p + 50;
    hold.target = rest[p + 50] + Eigen::Vector3d(0.0, 0.001, 0.0);
    input.landmarks.push_back(hold);
  }
  const FinishResult result = FinishVertices(input, {});
  for (const Correspondence& fixed : input.fixed) {
    EXPECT_EQ(result.points[fixed.point], rest[fixed.point]);
  }
  for (const Correspondence& landmark : input.landmarks) {
    EXPECT_LT((result.points[landmark.point] - landmark.target).norm(), 1e-4);
  }
}

TEST(FinishVertices, IsTheSameForAMeshWhoseTrianglesShareNoVertices) {
  const PointCloud welded = MakeBody(1500);
  PointCloud loose;
  std::vector<int> origin;
  for (const auto& t : welded.triangles) {
    const int first = static_cast<int>(loose.size());
    loose.triangles.push_back({first, first + 1, first + 2});
    for (const int corner : t) {
      loose.points.push_back(welded.points[corner]);
      origin.push_back(corner);
    }
  }
  const Surface source(welded);
  const Surface loose_source(loose);
  const Surface target(WithWaves(MakeBody(4000), 0.005));
  const FinishResult expected = FinishVertices(InputOf(source, target), {});
  const FinishResult result = FinishVertices(InputOf(loose_source, target), {});
  for (std::size_t p = 0; p < result.points.size(); ++p) {
    // The order of the vertices, and therefore of all sums, is different.
    EXPECT_LT((result.points[p] - expected.points[origin[p]]).norm(), 1e-9) << p;
  }
}

TEST(FinishOptions, NameWhatIsWrong) {
  FinishOptions options;
  std::string error;
  EXPECT_TRUE(options.IsValid(&error));
  options.smoothing = 0.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_EQ(error, "smoothing is 0, expected a finite number > 0");
}

}  // namespace
}  // namespace ceres_ed
