// Loads shared objects for formats that need a large library, when a file of such a format is
// named.
#ifndef CERES_ED_IO_MESH_MESH_MODULE_H_
#define CERES_ED_IO_MESH_MESH_MODULE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// The functions of a module. It exports the function kMeshModuleSymbol, which has no parameters and
// returns one of these.
struct MeshModule {
  // The version of ceres_ed with which it was built.
  const char* version;
  // Fills `document` from the file `path`.
  Status (*read)(const std::string& path, PlyDocument* document);
  // Writes to `bytes` the contents of a file with `document`. `path` names the file in messages.
  Status (*encode)(const std::string& path, const PlyDocument& document, std::string* bytes);
};

using MeshModuleFunction = const MeshModule*();
inline constexpr char kMeshModuleSymbol[] = "ceres_ed_mesh_module";

// Returns the module in the shared object `file`, which OpenModule() finds (module_file.h). The
// error gives the message of the system or of the module.
StatusOr<const MeshModule*> LoadMeshModule(const std::string& file);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_MESH_MODULE_H_
