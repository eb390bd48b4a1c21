// One surface, drawn without a browser.
#ifndef CERES_ED_REPORT_PICTURE_PANEL_H_
#define CERES_ED_REPORT_PICTURE_PANEL_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/report/picture/theme.h>
#include <ceres_ed/report/view/scene.h>
#include <ceres_ed/report/view/view_camera.h>

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// The part of the plane at the distance 1 before the eye that a picture shows.
struct ViewFrame {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(-0.27);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(0.27);
};

// Takes points of a scene to pixels. In the frame of the eye x is right, y down and z forward, and
// the radius of the scene is 1.
class PanelCamera {
 public:
  // Shows what `frame` holds in a picture of `width` x `height` pixels, both >= 1.
  PanelCamera(const ViewCamera& camera,
              const SceneBall& ball,
              const ViewFrame& frame,
              int width,
              int height);

  Eigen::Vector3d ToEye(const Eigen::Vector3d& point) const;
  // Returns how many pixels a length has that lies in the middle of the scene.
  double PixelsOf(double length) const { return pinhole_.fx * length / radius_ / distance_; }
  // Returns a direction of the scene in the frame of the eye.
  Eigen::Vector3d TurnToEye(const Eigen::Vector3d& direction) const {
    return eye_from_scene_ * direction;
  }
  // Returns the places of points on the plane at the distance 1.
  Eigen::AlignedBox2d Extent(const std::vector<Eigen::Vector3d>& points) const;
  const PinholeCamera& pinhole() const { return pinhole_; }

 private:
  Eigen::Matrix3d eye_from_scene_;
  Eigen::Vector3d center_;
  double radius_;
  double distance_;
  PinholeCamera pinhole_;
};

struct PanelContents {
  const ViewSurface* surface = nullptr;
  // Where on its way the surface is, in [0, 1].
  double at = 1.0;
  // The key of the field that colours it; empty for a plain colour.
  std::string field;
  Rgb plain = {185, 192, 201};
  // The graph and the landmarks of the surface, or null.
  const ViewGraph* graph = nullptr;
  const std::vector<ViewLandmark>* landmarks = nullptr;
  // The frames of a sequence, whose camera is drawn, or null; and the radius of the scene.
  const Timeline* timeline = nullptr;
  double scene_radius = 1.0;
};

// Returns the picture of a panel. Its edges are smooth: it is drawn at twice its size.
ColorImage DrawPanel(const PanelContents& contents,
                     const ViewCamera& camera,
                     const SceneBall& ball,
                     const ViewFrame& frame,
                     int width,
                     int height,
                     Theme theme);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_PICTURE_PANEL_H_
