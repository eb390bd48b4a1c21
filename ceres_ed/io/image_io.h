// PNG and JPEG by OpenCV, which stays inside image_io.cc.
#ifndef CERES_ED_IO_IMAGE_IO_H_
#define CERES_ED_IO_IMAGE_IO_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads a picture of one channel with 16 (or 8) bits: metres = stored number / units_per_metre,
// and 0 stays 0, "no depth". Errors name the file: it can't be opened or decoded, it has colours,
// its numbers have another type.
StatusOr<DepthImage> ReadDepthImage(const std::string& path, double units_per_metre);

// Reads a picture of 8 bits a channel; a grey one becomes red = green = blue. Errors as above.
StatusOr<ColorImage> ReadColorImage(const std::string& path);

// Reads a mask: nonzero in any channel counts. Errors as above.
StatusOr<MaskImage> ReadMaskImage(const std::string& path);

// Write PNGs under a temporary name and rename them. Depth is rounded to the nearest unit; what is
// not finite, not positive or too far for 16 bits is written as 0.
Status WriteDepthImage(const std::string& path, const DepthImage& depth, double units_per_metre);
Status WriteColorImage(const std::string& path, const ColorImage& color);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_IMAGE_IO_H_
