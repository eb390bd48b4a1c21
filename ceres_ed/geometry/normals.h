// Normals of meshes and of bare points.
#ifndef CERES_ED_GEOMETRY_NORMALS_H_
#define CERES_ED_GEOMETRY_NORMALS_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Neighbours of a point in EstimateNormals, itself included.
inline constexpr int kNormalNeighbors = 12;

// One unit normal a point from the triangles, weighted by their angle at the point and shared by
// all points at the same position; zero for points in no triangle of positive area.
std::vector<Eigen::Vector3d> ComputeVertexNormals(const PointCloud& cloud);

// One unit normal a point: the direction of least spread of its `neighbors` nearest points (itself
// included, at least 3). Zero where these do not span a plane. Signs are a guess: they agree along
// a minimum spanning tree of the neighbour graph with edges weighted by 1 - |n_i . n_j| (Hoppe et
// al. 1992), and each connected part points outward by the sign of the sum of (p - c) . n over its
// points with c their centroid. Right for closed shapes; for an open sheet it is the convex side.
std::vector<Eigen::Vector3d> EstimateNormals(const std::vector<Eigen::Vector3d>& points,
                                             int neighbors = kNormalNeighbors,
                                             int num_threads = 1);

// Fills in `cloud->normals` unless there is one for each point already: from the triangles where
// there are some (normals_oriented = true), else by EstimateNormals (normals_oriented = false:
// match them up to sign).
void EnsureNormals(PointCloud* cloud, int num_threads = 1);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_NORMALS_H_
