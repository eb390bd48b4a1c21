#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/simulation/shape_family.h>

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

ShapeFamilyOptions Small() {
  ShapeFamilyOptions options;
  options.shapes = 2;
  options.vertices = 700;
  return options;
}

TEST(ShapeFamily, TruthLiesOnEachShape) {
  const ShapeFamily family(Small());
  for (const int shape : {0, 1}) {
    const PointCloud cloud = family.Shape(shape);
    EXPECT_NE(cloud.size(), family.source().size());
    const SurfaceIndex surface(cloud);
    const std::vector<Eigen::Vector3d> truth = family.Truth(shape);
    std::vector<double> distances;
    for (const Eigen::Vector3d& point : truth) {
      distances.push_back(std::sqrt(surface.Closest(point).squared_distance));
    }
    // The facets of two meshes of one body are so far apart.
    std::sort(distances.begin(), distances.end());
    EXPECT_LT(distances[distances.size() * 95 / 100], 0.01 * Diagonal(cloud.points));
  }
}

TEST(ShapeFamily, IsTheSameEachTime) {
  EXPECT_EQ(ShapeFamily(Small()).Truth(1), ShapeFamily(Small()).Truth(1));
}

TEST(ShapeFamily, GroupsDifferInTheFirstMode) {
  ShapeFamilyOptions options = Small();
  const ShapeFamily one(options);
  options.groups = true;
  const ShapeFamily two(options);
  EXPECT_EQ(one.amplitudes(0), two.amplitudes(0));
  EXPECT_GT(two.amplitudes(1)[0], one.amplitudes(1)[0]);
  EXPECT_EQ(one.amplitudes(1)[1], two.amplitudes(1)[1]);
}

}  // namespace
}  // namespace ceres_ed
