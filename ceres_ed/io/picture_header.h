// What the first bytes of a picture promise, before a decoder believes them.
#ifndef CERES_ED_IO_PICTURE_HEADER_H_
#define CERES_ED_IO_PICTURE_HEADER_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <string_view>

namespace ceres_ed {

// The most pixels of a picture: 8192 x 8192. With four channels of 16 bits they take 512 MB.
inline constexpr double kMostPixels = 1 << 26;

// Returns an error for bytes that are no PNG, JPEG or TIFF, or whose header promises more than
// kMostPixels, or more than so many bytes can be: the decoder would allocate and fill them all
// before it misses their data. `path` names the file in errors. Bytes in which no size is found
// pass: the decoder refuses them.
Status CheckPictureHeader(const std::string& path, std::string_view bytes);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_PICTURE_HEADER_H_
