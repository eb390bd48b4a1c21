// The disparity of each pixel: the difference of columns at which the two pictures show the same
// point.
#ifndef CERES_ED_STEREO_DISPARITY_H_
#define CERES_ED_STEREO_DISPARITY_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/stereo/stereo_options.h>

#include <cstdint>
#include <limits>

namespace ceres_ed {

// The disparity d = u_left - u_right of each pixel of the left picture, in pixels. It is
// kNoDisparity where it is not known.
using DisparityImage = Image<float>;
inline constexpr float kNoDisparity = -std::numeric_limits<float>::max();

// Brightness, 0 to 255.
using GrayImage = Image<std::uint8_t>;

// The disparities from `min` to `min + count - 1`; they may be negative.
struct DisparityRange {
  int min = 0;
  int count = 0;
};

// Returns the disparity of each pixel by semi-global matching with OpenCV, in steps of 1/16 pixel.
// The two pictures are rectified and of one size. Pixels are left out if their match is not unique
// or outside of the right picture, if the left-right check fails, and if they are speckles.
DisparityImage MatchRows(const GrayImage& left,
                         const GrayImage& right,
                         const DisparityRange& range,
                         const StereoOptions& options);

// Returns the range of the disparities in a small copy of the pair, with a margin; count = 0 if
// nothing could be matched. `offset` is the disparity of a point at infinity; pixels with a mask of
// zero are left out.
DisparityRange FindRange(const GrayImage& left,
                         const GrayImage& right,
                         const MaskImage& left_mask,
                         double offset);

// Improves disparities by the gradient of the pictures. At each pixel it solves for the shift that
// makes a window of the left picture L equal to that of the right one R, up to a difference in
// brightness c (Lucas and Kanade 1981, along the row):
//
//   min over s, c of sum (L(u) - R(u - d(u) - s) - c)^2
//
// where the window follows the given disparities, so that slanted surfaces are not flattened. A
// pixel whose shift is not determined, or is larger than a pixel, keeps its disparity.
void RefineDisparity(const GrayImage& left, const GrayImage& right, DisparityImage* disparity);

// Leaves out pixels whose windows in the two pictures look different: the correlation of their
// brightness is less than `least`, -1 to 1. In a dark or even part of the pictures there is only
// noise, which has a correlation of 0.
void LeaveOutUnlike(const GrayImage& left,
                    const GrayImage& right,
                    double least,
                    DisparityImage* disparity);

// Leaves out pixels within `margin` pixels of a jump of more than a pixel, or of a part without
// disparity that is not small: there a window lies on two surfaces, and what is nearer seems wider
// than it is.
void LeaveOutEdges(int margin, DisparityImage* disparity);

// Smooths within `radius` pixels, but not across edges of more than about a pixel.
void SmoothDisparity(int radius, DisparityImage* disparity);

// Returns a picture of half the size; each pixel is the mean of four. The last row or column of an
// odd size is lost.
GrayImage HalfSize(const GrayImage& image);

// Returns the disparities of a picture twice as wide, of the given size.
DisparityImage DoubleSize(const DisparityImage& half, int width, int height);

// Sets to zero what is within `radius` pixels of a zero.
void Shrink(int radius, MaskImage* mask);

}  // namespace ceres_ed

#endif  // CERES_ED_STEREO_DISPARITY_H_
