#include "ceres_ed/pcl/greedy_surface.h"

#include <ceres_ed/version.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

namespace ceres_ed {
namespace {

// Neighbours are those up to this many times the distance of the nearest point.
constexpr double kReach = 3.0;
constexpr int kMostNeighbors = 60;
// The least cosine between a triangle's normal and those of its points.
constexpr double kUpright = 0.2;
constexpr double kRadiansPerDegree = M_PI / 180.0;

// Returns the points in the unit of the longest edge, around their first one, because PCL has
// floats and bounds for lengths.
pcl::PointCloud<pcl::PointNormal>::Ptr MakeCloud(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<Eigen::Vector3d>& normals,
                                                 double longest_edge) {
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud(new pcl::PointCloud<pcl::PointNormal>);
  cloud->reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f at = ((points[i] - points[0]) / longest_edge).cast<float>();
    pcl::PointNormal point;
    point.getVector3fMap() = at;
    point.getNormalVector3fMap() = normals[i].cast<float>();
    cloud->push_back(point);
  }
  return cloud;
}

}  // namespace

Status ConnectByGreedyProjection(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<Eigen::Vector3d>& normals,
                                 double longest_edge,
                                 SurfaceTriangles* triangles) {
  triangles->clear();
  if (points.size() < 3) return Status::Ok();
  try {
    const auto cloud = MakeCloud(points, normals, longest_edge);
    pcl::search::KdTree<pcl::PointNormal>::Ptr tree(new pcl::search::KdTree<pcl::PointNormal>);
    tree->setInputCloud(cloud);
    pcl::GreedyProjectionTriangulation<pcl::PointNormal> projection;
    projection.setSearchRadius(1.0);
    projection.setMu(kReach);
    projection.setMaximumNearestNeighbors(kMostNeighbors);
    projection.setMaximumSurfaceAngle(60.0 * kRadiansPerDegree);
    projection.setMinimumAngle(10.0 * kRadiansPerDegree);
    projection.setMaximumAngle(130.0 * kRadiansPerDegree);
    projection.setNormalConsistency(true);
    projection.setConsistentVertexOrdering(true);
    projection.setInputCloud(cloud);
    projection.setSearchMethod(tree);
    std::vector<pcl::Vertices> found;
    projection.reconstruct(found);
    for (const pcl::Vertices& face : found) {
      if (face.vertices.size() != 3) continue;
      std::array<int, 3> t = {static_cast<int>(face.vertices[0]),
                              static_cast<int>(face.vertices[1]),
                              static_cast<int>(face.vertices[2])};
      // PCL lets some triangles have a point twice.
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      const Eigen::Vector3d side = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
      const Eigen::Vector3d normal = normals[t[0]] + normals[t[1]] + normals[t[2]];
      const double along = side.dot(normal);
      // Three points in a row make a triangle that stands on the surface.
      if (!(std::abs(along) > kUpright * side.norm() * normal.norm())) continue;
      if (along < 0.0) std::swap(t[1], t[2]);
      triangles->push_back(t);
    }
  } catch (const std::exception& error) {
    return Status::Error(std::string("PCL cannot connect the points: ") + error.what());
  }
  return Status::Ok();
}

}  // namespace ceres_ed

extern "C" [[gnu::visibility("default")]] const ceres_ed::SurfaceModule* ceres_ed_surface_module() {
  static const ceres_ed::SurfaceModule module = {CERES_ED_VERSION_STRING,
                                                 ceres_ed::ConnectByGreedyProjection};
  return &module;
}
