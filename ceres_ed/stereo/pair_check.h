// Tells whether two pictures are the rectified left and right picture of one scene.
#ifndef CERES_ED_STEREO_PAIR_CHECK_H_
#define CERES_ED_STEREO_PAIR_CHECK_H_

#include <ceres_ed/stereo/disparity.h>

#include <string>

namespace ceres_ed {

// What corners that are found in both pictures say.
struct PairFindings {
  // The number of corners that are in both pictures.
  int corners = 0;
  // The median of v_right - v_left and its median absolute deviation, in pixels.
  double row_difference = 0.0;
  double row_spread = 0.0;
  // The share of the corners that are behind infinity: u_left - u_right < offset.
  double behind = 0.0;

  // Returns by how much the rows of a point typically differ, in pixels.
  double RowError() const;
  // Return whether there are enough corners, and most of them are behind infinity, as they are if
  // left is right; or whether the rows do not correspond so that nothing can be compared (3
  // pixels); or whether they differ so much that depth suffers (1 pixel).
  bool IsSwapped() const;
  bool IsUnrectified() const;
  bool IsRough() const;
};

// Returns what two rectified pictures have in common. `offset` is the disparity of a point at
// infinity. Pixels of the left picture with a mask of zero are not used.
PairFindings CheckPair(const GrayImage& left,
                       const GrayImage& right,
                       const MaskImage& left_mask,
                       double offset);

}  // namespace ceres_ed

#endif  // CERES_ED_STEREO_PAIR_CHECK_H_
