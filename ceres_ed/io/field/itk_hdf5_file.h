// Displacement fields in ITK's transform files of the format HDF5.
#ifndef CERES_ED_IO_FIELD_ITK_HDF5_FILE_H_
#define CERES_ED_IO_FIELD_ITK_HDF5_FILE_H_

#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes a field in left-posterior-superior coordinates in mm as a transform of the type
// DisplacementFieldTransform_double_3_3. This is done by ceres_ed's module for HDF5, which is
// loaded for it. The error says which package has the module if there is none.
Status WriteItkHdf5Field(const std::string& path, const DisplacementField& field);

// The functions of the module. It exports the function kHdf5ModuleSymbol, which has no parameters
// and returns one of these.
struct Hdf5Module {
  // The version of ceres_ed with which it was built.
  const char* version;
  // Returns the bytes of the file. `path` is for messages.
  StatusOr<std::string> (*make_itk_field)(const std::string& path, const DisplacementField& field);
};

using Hdf5ModuleFunction = const Hdf5Module*();
inline constexpr char kHdf5ModuleSymbol[] = "ceres_ed_hdf5_module";

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_ITK_HDF5_FILE_H_
