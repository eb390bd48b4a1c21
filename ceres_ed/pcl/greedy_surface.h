// Triangles between points, by PCL.
#ifndef CERES_ED_PCL_GREEDY_SURFACE_H_
#define CERES_ED_PCL_GREEDY_SURFACE_H_

#include <ceres_ed/io/mesh/surface_module.h>

namespace ceres_ed {

// Does what ConnectPoints() (io/mesh/surface_module.h) says.
Status ConnectByGreedyProjection(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<Eigen::Vector3d>& normals,
                                 double longest_edge,
                                 SurfaceTriangles* triangles);

}  // namespace ceres_ed

#endif  // CERES_ED_PCL_GREEDY_SURFACE_H_
