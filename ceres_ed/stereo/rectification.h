// Makes the rows of the two pictures of a stereo camera correspond.
#ifndef CERES_ED_STEREO_RECTIFICATION_H_
#define CERES_ED_STEREO_RECTIFICATION_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/rigid_transform.h>
#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/util/status.h>

#include <memory>

namespace ceres_ed {

// A stereo camera whose pictures have corresponding rows. A point at depth z is in column u of the
// left and u - d of the right picture, with d = f b / z + offset.
struct RectifiedRig {
  // The left camera.
  PinholeCamera camera;
  // The distance of the cameras, in metres, > 0.
  double baseline = 0.0;
  // The disparity of a point at infinity: cx of the left minus that of the right camera, in pixels.
  double offset = 0.0;
  // point_in_rectified_left_camera = rectified_from_left * point_in_left_camera. A rotation only.
  RigidTransform rectified_from_left;

  // Returns f b, in pixels times metres.
  double FocalTimesBaseline() const { return camera.fx * baseline; }
};

// The pictures of both cameras after rectification.
struct RectifiedPair {
  ColorImage left;
  ColorImage right;
  // Nonzero where the pictures show something and the mask of the left one is not zero.
  MaskImage left_mask;
  MaskImage right_mask;
};

// Rectifies pairs of pictures.
class Rectification {
 public:
  // `is_rectified` says that the pictures of `rig` are rectified already; then they are not
  // changed. It is an error, which says what to do, if a number of the rig is not finite, the two
  // sizes differ, the cameras are at one place or one above the other, or the right camera is at
  // the left of the left one.
  static StatusOr<std::unique_ptr<Rectification>> Create(const StereoRig& rig, bool is_rectified);
  ~Rectification();
  Rectification(const Rectification&) = delete;
  Rectification& operator=(const Rectification&) = delete;

  const RectifiedRig& rig() const { return rig_; }

  // Returns the rectified pictures. Both have the size of the rig's cameras; `mask` has, too, or is
  // empty.
  RectifiedPair Apply(const ColorImage& left, const ColorImage& right, const MaskImage& mask) const;

 private:
  // Where each pixel of the rectified pictures is in the given ones.
  struct Maps;

  Rectification();

  RectifiedRig rig_;
  // Null if the pictures are rectified already.
  std::unique_ptr<const Maps> maps_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_STEREO_RECTIFICATION_H_
