// JPEG files, for the pictures of a sequence in a page.
#ifndef CERES_ED_REPORT_PICTURE_JPEG_H_
#define CERES_ED_REPORT_PICTURE_JPEG_H_

#include <ceres_ed/geometry/images.h>

#include <string>

namespace ceres_ed {

// Returns the bytes of a JPEG file of modest size; empty for a picture without pixels, and where
// this build has no pictures (HasPictures()).
std::string EncodeJpeg(const ColorImage& picture);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_PICTURE_JPEG_H_
