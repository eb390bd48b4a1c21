// Displacement fields in NIfTI-1 files (https://nifti.nimh.nih.gov/nifti-1).
#ifndef CERES_ED_IO_FIELD_NIFTI_FILE_H_
#define CERES_ED_IO_FIELD_NIFTI_FILE_H_

#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes a field in left-posterior-superior coordinates in mm as ITK and ANTs write theirs: five
// dimensions with the components last, and the intent NIFTI_INTENT_VECTOR (1007). The grid in qform
// and sform is in right-anterior-superior coordinates, as the format wants it; the vectors stay in
// left-posterior-superior ones, as all versions of ITK read this intent. (With
// NIFTI_INTENT_DISPVECT they would be right-anterior-superior, and ITK before 5.4 would read them
// with the wrong signs.) The error says which dimension the format can't hold.
Status WriteNiftiField(const std::string& path, const DisplacementField& field);

// Does the same, compressed as by gzip. Returns an error if this build can't do that.
Status WriteNiftiGzField(const std::string& path, const DisplacementField& field);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_NIFTI_FILE_H_
