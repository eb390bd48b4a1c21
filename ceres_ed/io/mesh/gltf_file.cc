#include "ceres_ed/io/mesh/gltf_file.h"

#include <ceres_ed/io/mesh/mesh_module.h>

namespace ceres_ed {
namespace {

constexpr MeshModuleFile kModule = {
    CERES_ED_GLTF_MODULE, "GLB", "glTF", "ceres-ed-gltf", "libtinygltf-dev"};

}  // namespace

StatusOr<PlyDocument> ReadGlb(const std::string& path) { return ReadByModule(kModule, path); }

Status WriteGlb(const std::string& path, const PlyDocument& document) {
  return WriteByModule(kModule, path, document);
}

}  // namespace ceres_ed
