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
  // Writes to `bytes` the contents of a file with `document`. `path` names the file in messages,
  // and its ending is that of the format.
  Status (*encode)(const std::string& path, const PlyDocument& document, std::string* bytes);
};

using MeshModuleFunction = const MeshModule*();
inline constexpr char kMeshModuleSymbol[] = "ceres_ed_mesh_module";

// A module, and what to say where it is missing.
struct MeshModuleFile {
  // The name of the shared object, without folders.
  const char* file;
  // For example "PCD" and "PCL".
  const char* format;
  const char* library;
  // The Debian package that has the module, and the one from which it is built.
  const char* package;
  const char* build_package;
};

// Returns the module in the shared object `file`, which OpenModule() finds (module_file.h). The
// error gives the message of the system or of the module.
StatusOr<const MeshModule*> LoadMeshModule(const std::string& file);

// Reads and writes a file by a module. Errors name the file: it can't be read or written, or the
// module is missing (and how to get it).
StatusOr<PlyDocument> ReadByModule(const MeshModuleFile& module, const std::string& path);
Status WriteByModule(const MeshModuleFile& module,
                     const std::string& path,
                     const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_MESH_MODULE_H_
