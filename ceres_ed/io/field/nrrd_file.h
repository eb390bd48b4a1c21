// Displacement fields in NRRD files (http://teem.sourceforge.net/nrrd/format.html).
#ifndef CERES_ED_IO_FIELD_NRRD_FILE_H_
#define CERES_ED_IO_FIELD_NRRD_FILE_H_

#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes a field in left-posterior-superior coordinates in mm as NRRD of version 5: a text header,
// and the vectors as 32-bit floats, compressed if this build can do that. The measurement frame is
// the identity: the vectors are in the coordinates of the header, too.
Status WriteNrrdField(const std::string& path, const DisplacementField& field);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_NRRD_FILE_H_
