#include "ceres_ed/preflight/preflight.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PointCloud Body() { return MakeSyntheticShape(SyntheticShape::kHeart, 3000, 1.0); }

std::vector<std::string> CodesOf(const std::vector<Finding>& findings) {
  std::vector<std::string> codes;
  for (const Finding& finding : findings) {
    codes.push_back(finding.code);
    EXPECT_FALSE(finding.text.empty());
    EXPECT_FALSE(finding.fix.empty());
  }
  return codes;
}

std::vector<std::string> CodesOf(const PointCloud& cloud, bool has_floats = false) {
  const SurfaceTopology topology = BuildTopology(cloud);
  return CodesOf(InspectCloud({"it", &cloud, &topology, has_floats}));
}

std::vector<Finding> FindingsOf(const PointCloud& source, const PointCloud& target) {
  const SurfaceTopology from = BuildTopology(source);
  const SurfaceTopology to = BuildTopology(target);
  return InspectPair({"source", &source, &from}, {"target", &target, &to});
}

PointCloud Changed(const std::function<void(PointCloud*)>& change) {
  PointCloud cloud = Body();
  cloud.normals.clear();
  change(&cloud);
  return cloud;
}

TEST(Preflight, FindsNothingInAWholeBody) {
  EXPECT_THAT(CodesOf(Body(), true), IsEmpty());
  EXPECT_THAT(CodesOf(MakeSyntheticShape(SyntheticShape::kDolphin, 3000, 1.0), true), IsEmpty());
  EXPECT_THAT(FindingsOf(Body(), Body()), IsEmpty());
}

TEST(Preflight, FindsEachFaultOfOneCloud) {
  const struct {
    const char* code;
    std::function<void(PointCloud*)> change;
  } cases[] = {
      {"vertices_at_origin",
       [](PointCloud* cloud) {
         for (Eigen::Vector3d& point : cloud->points) point.x() += 3.0;
         for (int i = 0; i < 5; ++i) cloud->points.emplace_back(Eigen::Vector3d::Zero());
       }},
      {"far_vertices", [](PointCloud* cloud) { cloud->points.emplace_back(500.0, 0.0, 0.0); }},
      {"winding",
       [](PointCloud* cloud) {
         for (std::size_t t = 0; t < cloud->triangles.size(); t += 5) {
           std::swap(cloud->triangles[t][0], cloud->triangles[t][1]);
         }
       }},
      {"inside_out",
       [](PointCloud* cloud) {
         for (auto& triangle : cloud->triangles) std::swap(triangle[0], triangle[1]);
       }},
      {"normals",
       [](PointCloud* cloud) {
         cloud->normals = ComputeVertexNormals(*cloud);
         for (std::size_t p = 0; p < cloud->size(); p += 3) cloud->normals[p] *= -1.0;
       }},
      {"soup",
       [](PointCloud* cloud) {
         PointCloud soup;
         for (const auto& triangle : cloud->triangles) {
           const int first = static_cast<int>(soup.size());
           for (const int corner : triangle) soup.points.push_back(cloud->points[corner]);
           soup.triangles.push_back({first, first + 1, first + 2});
         }
         *cloud = soup;
       }},
      {"duplicate_faces",
       [](PointCloud* cloud) {
         for (auto triangle : {cloud->triangles[3], cloud->triangles[8]}) {
           cloud->triangles.push_back({triangle[1], triangle[2], triangle[0]});
         }
       }},
      {"degenerate_faces",
       [](PointCloud* cloud) {
         const int last = static_cast<int>(cloud->size());
         for (int i = 0; i < 3; ++i) cloud->points.emplace_back(0.01 * i, 0.0, 0.0);
         cloud->triangles.push_back({last, last + 1, last + 2});
       }},
  };
  for (const auto& c : cases) {
    const std::vector<std::string> codes = CodesOf(Changed(c.change));
    EXPECT_THAT(codes, ::testing::Contains(c.code));
  }
}

TEST(Preflight, LeavesOutTheChecksAfterAStop) {
  const PointCloud cloud = Changed([](PointCloud* body) {
    body->points.emplace_back(500.0, 0.0, 0.0);
    body->triangles.push_back(body->triangles[3]);
  });
  const SurfaceTopology topology = BuildTopology(cloud);
  const Specimen specimen = {"it", &cloud, &topology, false};
  int polls = 0;
  const std::vector<Finding> all = InspectCloud(specimen, [&polls] {
    ++polls;
    return false;
  });
  const std::vector<std::string> codes = CodesOf(all);
  EXPECT_THAT(codes, ::testing::Contains("far_vertices"));
  EXPECT_THAT(codes, ::testing::Contains("duplicate_faces"));
  // A stop before each check in turn leaves the findings of those before it.
  for (int last = 0; last < polls; ++last) {
    int asked = 0;
    const std::vector<std::string> some =
        CodesOf(InspectCloud(specimen, [&] { return asked++ == last; }));
    ASSERT_LE(some.size(), codes.size());
    EXPECT_TRUE(std::equal(some.begin(), some.end(), codes.begin()));
    EXPECT_EQ(asked, last + 1);
    if (last == 0) {
      EXPECT_THAT(some, IsEmpty());
    }
  }
  EXPECT_THAT(InspectPair(specimen, specimen, [] { return true; }), IsEmpty());
}

TEST(Preflight, CountsTheEdgesOfMoreThanTwoTriangles) {
  const PointCloud cloud = Changed([](PointCloud* body) {
    const auto [a, b, c] = body->triangles[0];
    const int last = static_cast<int>(body->size());
    body->points.emplace_back(body->points[c] + 0.1 * Eigen::Vector3d::Ones());
    body->triangles.push_back({a, b, last});
  });
  const SurfaceTopology topology = BuildTopology(cloud);
  const std::vector<Finding> findings = InspectCloud({"it", &cloud, &topology, false});
  EXPECT_THAT(CodesOf(findings), ElementsAre("non_manifold_edges"));
  EXPECT_THAT(findings[0].text, HasSubstr("1 edge"));
}

TEST(Preflight, FindsFloatsFarFromTheOrigin) {
  const PointCloud cloud = Changed([](PointCloud* body) {
    for (Eigen::Vector3d& point : body->points) point += Eigen::Vector3d(4e5, 5e6, 0.0);
  });
  EXPECT_THAT(CodesOf(cloud, true), ElementsAre("float_positions"));
  EXPECT_THAT(CodesOf(cloud, false), IsEmpty());
}

TEST(Preflight, FindsNoiseThatIsFinerThanTheNodes) {
  PointCloud cloud = MakeSyntheticShape(SyntheticShape::kHeart, 12000, 1.0);
  EXPECT_THAT(CodesOf(cloud), IsEmpty());
  cloud.normals.clear();
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    const double at = static_cast<double>(p);
    cloud.points[p] +=
        0.02 * Eigen::Vector3d(std::sin(7.1 * at), std::sin(5.3 * at + 1.0), std::sin(3.7 * at));
  }
  EXPECT_THAT(CodesOf(cloud), ElementsAre("detail"));
}

TEST(Preflight, NamesTheRatioOfUnits) {
  const PointCloud source = Body();
  for (const double factor : {1000.0, 0.01, 25.4, 9.0, 5.0}) {
    PointCloud target = Body();
    for (Eigen::Vector3d& point : target.points) point *= factor;
    const std::vector<Finding> findings = FindingsOf(source, target);
    EXPECT_THAT(CodesOf(findings), ElementsAre("units")) << factor;
    EXPECT_THAT(findings[0].fix,
                HasSubstr(factor == 1000.0 ? "--scale=1000 "
                          : factor == 0.01 ? "--scale=0.01 "
                          : factor == 25.4 ? "--scale=25.4 "
                          : factor == 9.0  ? "--scale=10 "
                                           : "--scale=auto if"));
  }
}

TEST(Preflight, TellsAMirrorImageFromATurnedCopy) {
  const PointCloud source = Body();
  PointCloud turned = Body();
  const Eigen::AngleAxisd turn(2.0, Eigen::Vector3d(1.0, 2.0, 0.5).normalized());
  for (Eigen::Vector3d& point : turned.points) point = turn * point;
  EXPECT_THAT(CodesOf(FindingsOf(source, turned)), IsEmpty());
  PointCloud mirrored = turned;
  for (Eigen::Vector3d& point : mirrored.points) point.x() *= -1.0;
  EXPECT_THAT(CodesOf(FindingsOf(source, mirrored)), ElementsAre("mirrored"));
}

TEST(Preflight, SaysThatSurfacesAreFarApart) {
  PointCloud target = Body();
  for (Eigen::Vector3d& point : target.points) point.y() += 1.3;
  EXPECT_THAT(CodesOf(FindingsOf(Body(), target)), ElementsAre("overlap"));
}

}  // namespace
}  // namespace ceres_ed
