// Reads the pictures that a listing names.
#ifndef CERES_ED_IO_SEQUENCE_PICTURE_READER_H_
#define CERES_ED_IO_SEQUENCE_PICTURE_READER_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/io/sequence/picture_source.h>
#include <ceres_ed/util/status.h>

namespace ceres_ed {

// Returns the picture, mask or depth of a source. Pixels of the mask that are left out are 0, and
// the others are not. Masks and depth are files of one picture. Errors name the file and what is
// wrong with it, as in image_io.h and video_file.h.
StatusOr<ColorImage> ReadColor(const PictureSource& source);
StatusOr<MaskImage> ReadMask(const PictureSource& source, MaskMeaning meaning);
// `saturated` is as in ReadDepthImage().
StatusOr<DepthImage> ReadDepth(const PictureSource& source, double units_per_metre, int* saturated);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_PICTURE_READER_H_
