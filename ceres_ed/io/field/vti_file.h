// Displacement fields in files of VTK (https://docs.vtk.org/en/latest/vtk_file_formats).
#ifndef CERES_ED_IO_FIELD_VTI_FILE_H_
#define CERES_ED_IO_FIELD_VTI_FILE_H_

#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes a field in any coordinates as XML image data: the point vectors `displacement`, 32-bit
// floats, appended without an encoding.
Status WriteVtiField(const std::string& path, const DisplacementField& field);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_VTI_FILE_H_
