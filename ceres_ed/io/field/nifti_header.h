// The header of a NIfTI-1 file.
#ifndef CERES_ED_IO_FIELD_NIFTI_HEADER_H_
#define CERES_ED_IO_FIELD_NIFTI_HEADER_H_

#include <cstdint>

namespace ceres_ed {

// The first 348 bytes of a file, with the names of the format's definition. A reader tells the
// order of the bytes by sizeof_hdr.
struct NiftiHeader {
  std::int32_t sizeof_hdr = 348;
  char unused_analyze[35] = {};
  std::uint8_t dim_info = 0;
  // The number of dimensions, and their sizes.
  std::int16_t dim[8] = {};
  float intent_p[3] = {};
  std::int16_t intent_code = 0;
  std::int16_t datatype = 0;
  std::int16_t bitpix = 0;
  std::int16_t slice_start = 0;
  // The sign of the third axis in the first entry, and the spacings.
  float pixdim[8] = {};
  float vox_offset = 0.0f;
  float scl_slope = 0.0f;
  float scl_inter = 0.0f;
  std::int16_t slice_end = 0;
  std::uint8_t slice_code = 0;
  std::uint8_t xyzt_units = 0;
  float cal_max = 0.0f;
  float cal_min = 0.0f;
  float slice_duration = 0.0f;
  float toffset = 0.0f;
  std::int32_t glmax = 0;
  std::int32_t glmin = 0;
  char descrip[80] = {};
  char aux_file[24] = {};
  std::int16_t qform_code = 0;
  std::int16_t sform_code = 0;
  // b, c, d of the unit quaternion, and the position of the first point.
  float quatern[3] = {};
  float qoffset[3] = {};
  // The rows of the affine map from indices to positions.
  float srow[3][4] = {};
  char intent_name[16] = {};
  char magic[4] = {'n', '+', '1', '\0'};
};

static_assert(sizeof(NiftiHeader) == 348, "the header of NIfTI-1 has 348 bytes");

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_NIFTI_HEADER_H_
