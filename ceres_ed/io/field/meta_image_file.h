// Displacement fields in MetaImage files (https://itk.org/Wiki/ITK/MetaIO/Documentation).
#ifndef CERES_ED_IO_FIELD_META_IMAGE_FILE_H_
#define CERES_ED_IO_FIELD_META_IMAGE_FILE_H_

#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes a field in left-posterior-superior coordinates in mm: a text header with the vectors as
// 32-bit floats behind it. The format can't say its coordinates; its readers take them for these.
Status WriteMhaField(const std::string& path, const DisplacementField& field);

// Does the same with the vectors in a second file beside `path`, whose name ends with .raw.
Status WriteMhdField(const std::string& path, const DisplacementField& field);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_META_IMAGE_FILE_H_
