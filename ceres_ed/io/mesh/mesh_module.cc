#include "ceres_ed/io/mesh/mesh_module.h"

#include <ceres_ed/io/module_file.h>
#include <ceres_ed/version.h>

namespace ceres_ed {

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

}  // namespace ceres_ed
