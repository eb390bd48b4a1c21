#include "ceres_ed/io/mesh/surface_module.h"

#include <ceres_ed/io/module_file.h>
#include <ceres_ed/version.h>

namespace ceres_ed {

StatusOr<SurfaceTriangles> ConnectPoints(const std::string& path,
                                         const std::vector<Eigen::Vector3d>& points,
                                         const std::vector<Eigen::Vector3d>& normals,
                                         double longest_edge) {
  const StatusOr<void*> symbol = OpenModule(CERES_ED_PCL_MODULE, kSurfaceModuleSymbol);
  if (!symbol.ok()) {
    return Status::Error(path +
                         ": a surface needs ceres_ed's module for PCL: install the package "
                         "ceres-ed-pcl, or libpcl-dev and build again (" +
                         symbol.status().message() + ")");
  }
  const SurfaceModule* const module = reinterpret_cast<SurfaceModuleFunction*>(*symbol)();
  if (module->version != std::string(CERES_ED_VERSION_STRING)) {
    return Status::Error(path + ": " + CERES_ED_PCL_MODULE + " belongs to ceres_ed " +
                         module->version + ", expected " + CERES_ED_VERSION_STRING);
  }
  SurfaceTriangles triangles;
  Status status = module->connect(points, normals, longest_edge, &triangles);
  if (!status.ok()) return Status::Error(path + ": " + status.message());
  return triangles;
}

}  // namespace ceres_ed
