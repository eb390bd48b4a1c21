// GLB files by tinygltf, for programs that load this module when such a file is named.
#include <ceres_ed/gltf/glb_file.h>
#include <ceres_ed/io/mesh/mesh_module.h>
#include <ceres_ed/version.h>

extern "C" [[gnu::visibility("default")]] const ceres_ed::MeshModule* ceres_ed_mesh_module() {
  static const ceres_ed::MeshModule module = {
      CERES_ED_VERSION_STRING, ceres_ed::ReadGlbFile, ceres_ed::EncodeGlb};
  return &module;
}
