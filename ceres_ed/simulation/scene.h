// What a simulated sequence shows: tissue that moves in time, and a camera's path.
#ifndef CERES_ED_SIMULATION_SCENE_H_
#define CERES_ED_SIMULATION_SCENE_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/simulation/shapes.h>

#include <memory>

#include <Eigen/Core>

namespace ceres_ed {

// Lengths are metres, points in the world frame. The tissue is at rest in frame 0.
class SyntheticScene {
 public:
  virtual ~SyntheticScene() = default;

  virtual int num_frames() const = 0;

  // Returns the whole tissue at rest: all of it from MaxVertices() on, else a mesh of about
  // `vertices` vertices (a strip: at most that many).
  virtual PointCloud RestMesh(int vertices) const = 0;

  // Return the most vertices that RestMesh() makes, and the fewest that still show the tissue.
  virtual int MaxVertices() const = 0;
  virtual int MinVertices() const = 0;

  // Returns the part of the tissue at rest that may be in the picture in `frame`, fine enough that
  // its facets stay within the depth's unit (0.1 mm) of the smooth surface.
  virtual PointCloud RestPatch(int frame) const = 0;

  // Returns where the tissue point that is at `rest` in frame 0 is in `frame`.
  virtual Eigen::Vector3d Deform(int frame, const Eigen::Vector3d& rest) const = 0;

  virtual CameraPose WorldFromCamera(int frame) const = 0;

  // Returns the pixels that count in `frame`, nothing where all do.
  virtual MaskImage Mask(int /*frame*/) const { return {}; }
};

// Returns the pose of a camera at `eye` that looks at `target` with the direction `up`, not
// parallel to the view, upward in the picture.
CameraPose LookAt(const Eigen::Vector3d& eye,
                  const Eigen::Vector3d& target,
                  const Eigen::Vector3d& up);

// An organ under a camera in orbit; see SyntheticSequence. `vertices` >= 500, `frames` >= 1,
// `period` >= 2 frames.
std::unique_ptr<SyntheticScene> MakeOrganScene(SyntheticShape shape,
                                               int vertices,
                                               int frames,
                                               double period);

// A sheet that is warped under a still camera; see SyntheticSequence.
std::unique_ptr<SyntheticScene> MakePlaneScene(int vertices,
                                               int frames,
                                               const PinholeCamera& camera);

// What one picture of the strip sees of it along its length, metres.
double StripViewLength(const PinholeCamera& camera);

// A band of `length` >= StripViewLength(camera) under a camera that moves along it from one end to
// the other; see SyntheticSequence.
std::unique_ptr<SyntheticScene> MakeStripScene(double length,
                                               int frames,
                                               double period,
                                               const PinholeCamera& camera);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SCENE_H_
