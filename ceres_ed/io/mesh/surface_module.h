// Connects points to a surface, by the module for PCL, which is loaded when this is asked for.
#ifndef CERES_ED_IO_MESH_SURFACE_MODULE_H_
#define CERES_ED_IO_MESH_SURFACE_MODULE_H_

#include <ceres_ed/util/status.h>

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

using SurfaceTriangles = std::vector<std::array<int, 3>>;

// The function of the module. It exports kSurfaceModuleSymbol, which has no parameters and returns
// one of these.
struct SurfaceModule {
  // The version of ceres_ed with which it was built.
  const char* version;
  // As ConnectPoints().
  Status (*connect)(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<Eigen::Vector3d>& normals,
                    double longest_edge,
                    SurfaceTriangles* triangles);
};

using SurfaceModuleFunction = const SurfaceModule*();
inline constexpr char kSurfaceModuleSymbol[] = "ceres_ed_surface_module";

// Returns triangles between neighbouring points, which stay where they are: greedy projection
// triangulation (Marton, Rusu and Beetz 2009). Edges are at most `longest_edge` > 0 long, in the
// unit of the points, and triangles are wound so that the normals, of unit length and as many as
// the points, are on their outer side. The same points give the same triangles in any unit. `path`
// names the file in errors: the module is missing (and how to get it), or PCL fails.
StatusOr<SurfaceTriangles> ConnectPoints(const std::string& path,
                                         const std::vector<Eigen::Vector3d>& points,
                                         const std::vector<Eigen::Vector3d>& normals,
                                         double longest_edge);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_SURFACE_MODULE_H_
