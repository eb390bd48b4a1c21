// Reads and writes PNG, JPEG and TIFF files with OpenCV, which only image_io.cc includes.
#ifndef CERES_ED_IO_IMAGE_IO_H_
#define CERES_ED_IO_IMAGE_IO_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads a depth image: metres = stored number / units_per_metre. The file is one of
//   PNG or TIFF of one channel with 16 (or 8) bits
//   TIFF of one channel of floats
//   TIFF of three channels of floats: x, y and z of the point that each pixel shows (SCARED)
//   .npy with (height, width) numbers
// 0 stays 0, which means "no depth", and so do numbers that are negative or not finite. The largest
// number of 16 bits, 65535, with which sensors mark pixels that are too far or were not measured,
// becomes 0, too; the number of these pixels is written to `saturated`, if that is not null. The
// error names the file: it can't be opened or decoded, it has colours, or its numbers have another
// type.
StatusOr<DepthImage> ReadDepthImage(const std::string& path,
                                    double units_per_metre,
                                    int* saturated = nullptr);

// Reads a colour image with 8 bits in each channel. A grey image gets red = green = blue. Errors
// are as above.
StatusOr<ColorImage> ReadColorImage(const std::string& path);

// Reads a mask: a pixel is nonzero if any channel is. Errors are as above.
StatusOr<MaskImage> ReadMaskImage(const std::string& path);

// The following functions write a file under a temporary name and then rename it: a PNG, or a TIFF
// if the name ends in .tiff. Depth is rounded to the nearest unit. A depth that is not finite, not
// positive or too large (65534 units) is written as 0.
Status WriteDepthImage(const std::string& path, const DepthImage& depth, double units_per_metre);
Status WriteColorImage(const std::string& path, const ColorImage& color);
// As above; a pixel that is not 0 is written as 255.
Status WriteMaskImage(const std::string& path, const MaskImage& mask);

// Writes a TIFF of three channels of floats: the point in the camera frame that each pixel shows,
// in metres times units_per_metre; not a number where there is no depth. `depth` has the camera's
// size.
Status WritePointImage(const std::string& path,
                       const PinholeCamera& camera,
                       const DepthImage& depth,
                       double units_per_metre);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_IMAGE_IO_H_
