// Tells whether two pictures are the rectified left and right picture of one scene.
#ifndef CERES_ED_STEREO_PAIR_CHECK_H_
#define CERES_ED_STEREO_PAIR_CHECK_H_

#include <ceres_ed/stereo/disparity.h>

namespace ceres_ed {

// What corners that are found in both pictures say.
struct PairFindings {
  // The number of corners in both pictures whose rows differ by one affine function of the place,
  // as the rows of two pictures of one scene approximately do whether they are rectified or not.
  int corners = 0;
  // The median of |v_right - v_left| over these, in pixels.
  double row_error = 0.0;
  // The share of them that are behind infinity: u_left - u_right < offset.
  double behind = 0.0;
  // Whether there are enough corners, and a large enough share of all that seemed to be in both
  // pictures. A picture of a regular pattern, for example, says nothing.
  bool is_conclusive = false;

  // Return whether most corners are behind infinity, as they are if left is right; or whether the
  // rows do not correspond so that nothing can be compared (3 pixels); or whether they differ so
  // much that depth suffers (1 pixel, for pictures of 480 rows).
  bool IsSwapped() const { return is_conclusive && behind > 0.7; }
  bool IsUnrectified() const { return is_conclusive && row_error > 3.0; }
  bool IsRough() const { return is_conclusive && row_error > 1.0; }
};

// Returns what two rectified pictures have in common. `offset` is the disparity of a point at
// infinity. Pixels of the left picture with a mask of zero are not used.
PairFindings CheckPair(const GrayImage& left,
                       const GrayImage& right,
                       const MaskImage& left_mask,
                       double offset);

}  // namespace ceres_ed

#endif  // CERES_ED_STEREO_PAIR_CHECK_H_
