#include "ceres_ed/io/mesh/vtk_file.h"

#include <ceres_ed/io/mesh/mesh_module.h>

namespace ceres_ed {
namespace {

constexpr MeshModuleFile kModule = {
    CERES_ED_VTK_MODULE, "VTK and VTP", "VTK", "ceres-ed-vtk", "libvtk9-dev"};

}  // namespace

StatusOr<PlyDocument> ReadVtk(const std::string& path) { return ReadByModule(kModule, path); }

Status WriteVtk(const std::string& path, const PlyDocument& document) {
  return WriteByModule(kModule, path, document);
}

}  // namespace ceres_ed
