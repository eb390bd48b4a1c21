#include "ceres_ed/io/field/itk_hdf5_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/module_file.h>
#include <ceres_ed/version.h>

namespace ceres_ed {
namespace {

StatusOr<const Hdf5Module*> LoadModule(const std::string& path) {
  const StatusOr<void*> symbol = OpenModule(CERES_ED_HDF5_MODULE, kHdf5ModuleSymbol);
  if (!symbol.ok()) {
    return Status::Error(path +
                         ": .h5 files need ceres_ed's module for them: install the package "
                         "ceres-ed-hdf5, or libhdf5-dev and build again (" +
                         symbol.status().message() + ")");
  }
  const Hdf5Module* const module = reinterpret_cast<Hdf5ModuleFunction*>(*symbol)();
  if (module->version == std::string(CERES_ED_VERSION_STRING)) return module;
  return Status::Error(std::string(CERES_ED_HDF5_MODULE) + " belongs to ceres_ed " +
                       module->version + ", expected " + CERES_ED_VERSION_STRING);
}

}  // namespace

Status WriteItkHdf5Field(const std::string& path, const DisplacementField& field) {
  const StatusOr<const Hdf5Module*> module = LoadModule(path);
  if (!module.ok()) return module.status();
  const StatusOr<std::string> bytes = (*module)->make_itk_field(path, field);
  if (!bytes.ok()) return bytes.status();
  return WriteFileAtomically(path, *bytes);
}

}  // namespace ceres_ed
