#include "ceres_ed/io/mesh/mesh_module.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/module_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/version.h>

#include <fstream>

namespace ceres_ed {
namespace {

StatusOr<const MeshModule*> LoadFor(const std::string& path, const MeshModuleFile& file) {
  StatusOr<const MeshModule*> module = LoadMeshModule(file.file);
  if (module.ok()) return module;
  return Status::Error(path + ": " + file.format + " files need ceres_ed's module for " +
                       file.library + ": install the package " + file.package + ", or " +
                       file.build_package + " and build again (" + module.status().message() + ")");
}

}  // namespace

StatusOr<const MeshModule*> LoadMeshModule(const std::string& file) {
  const StatusOr<void*> symbol = OpenModule(file, kMeshModuleSymbol);
  if (!symbol.ok()) return symbol.status();
  const MeshModule* const module = reinterpret_cast<MeshModuleFunction*>(*symbol)();
  if (module->version != std::string(CERES_ED_VERSION_STRING)) {
    return Status::Error(file + " belongs to ceres_ed " + module->version + ", expected " +
                         CERES_ED_VERSION_STRING);
  }
  return module;
}

StatusOr<PlyDocument> ReadByModule(const MeshModuleFile& file, const std::string& path) {
  std::ifstream probe;
  const StatusOr<std::size_t> size = OpenRegularFile(path, &probe);
  if (!size.ok()) return size.status();
  const StatusOr<const MeshModule*> module = LoadFor(path, file);
  if (!module.ok()) return module.status();
  PlyDocument document;
  Status status = (*module)->read(path, &document);
  if (!status.ok()) return status;
  return document;
}

Status WriteByModule(const MeshModuleFile& file,
                     const std::string& path,
                     const PlyDocument& document) {
  const StatusOr<const MeshModule*> module = LoadFor(path, file);
  if (!module.ok()) return module.status();
  std::string bytes;
  Status status = (*module)->encode(path, document, &bytes);
  return status.ok() ? WriteFileAtomically(path, bytes) : status;
}

}  // namespace ceres_ed
