// Normals of meshes and of points without triangles.
#ifndef CERES_ED_GEOMETRY_NORMALS_H_
#define CERES_ED_GEOMETRY_NORMALS_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The number of neighbours of a point in EstimateNormals(), the point itself included.
inline constexpr int kNormalNeighbors = 12;

// Returns one unit normal for each point, from the triangles at it weighted by their angle. All
// points at the same position share a normal. It is zero for points in no triangle of positive
// area.
std::vector<Eigen::Vector3d> ComputeVertexNormals(const PointCloud& cloud);

// Returns the normals of ComputeVertexNormals() at `points` alone, in their order. `topology` must
// be that of `cloud`.
std::vector<Eigen::Vector3d> ComputeVertexNormalsAt(const std::vector<int>& points,
                                                    const PointCloud& cloud,
                                                    const SurfaceTopology& topology);

// Returns one unit normal for each point: the direction in which its `neighbors` nearest points
// (itself included, at least 3) spread least. It is zero where these points do not span a plane.
//
// The signs are a guess. They agree along a minimum spanning tree of the neighbour graph, whose
// edges have the weight 1 - |n_i . n_j| (Hoppe et al. 1992). Each connected part points outward by
// the sign of the sum of (p - c) . n over its points, where c is their centroid. This is right for
// closed shapes; on an open sheet the normals point to the convex side. `largest_part`, if it is
// not null, receives the number of points of the largest connected part.
std::vector<Eigen::Vector3d> EstimateNormals(const std::vector<Eigen::Vector3d>& points,
                                             int neighbors = kNormalNeighbors,
                                             int num_threads = 1,
                                             int* largest_part = nullptr);

// Chooses the signs of `normals`, one unit normal for each point, as EstimateNormals() does. Their
// directions are kept.
void ChooseNormalSigns(const std::vector<Eigen::Vector3d>& points,
                       std::vector<Eigen::Vector3d>* normals,
                       int neighbors = kNormalNeighbors,
                       int num_threads = 1);

// Computes `cloud->normals` unless each point has a normal already. With triangles they come from
// ComputeVertexNormals() (normals_oriented = true). Otherwise they come from EstimateNormals()
// (normals_oriented = false: compare them up to sign).
void EnsureNormals(PointCloud* cloud, int num_threads = 1);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_NORMALS_H_
