// Formats that a large library reads, in a shared object that is loaded when such a file is named.
#ifndef CERES_ED_IO_MESH_MESH_MODULE_H_
#define CERES_ED_IO_MESH_MESH_MODULE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// What a module exports: the function kMeshModuleSymbol, without parameters, returns one.
struct MeshModule {
  // The version of ceres_ed that it was built with.
  const char* version;
  // Fills `document` from the file `path`.
  Status (*read)(const std::string& path, PlyDocument* document);
  // Sets `bytes` to what a file with `document` holds. `path` names the file in messages.
  Status (*encode)(const std::string& path, const PlyDocument& document, std::string* bytes);
};

using MeshModuleFunction = const MeshModule*();
inline constexpr char kMeshModuleSymbol[] = "ceres_ed_mesh_module";

// Returns the module in the shared object `file` (a name without folders), which stays loaded. It
// is looked for in the folder CERES_ED_MODULES of the environment, where that is set, beside the
// program or library that calls, in the folder of libraries that belongs to it, and where the
// system has its libraries. Errors say what the system or the module said.
StatusOr<const MeshModule*> LoadMeshModule(const std::string& file);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_MESH_MODULE_H_
