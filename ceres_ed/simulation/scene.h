// The content of a simulated sequence: tissue that moves in time, and the path of a camera.
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

// The interface of a scene. Lengths are in metres, points in the world frame. The tissue is at rest
// in frame 0.
class SyntheticScene {
 public:
  virtual ~SyntheticScene() = default;

  virtual int num_frames() const = 0;

  // Returns the whole tissue at rest as a mesh of about `vertices` vertices (for a strip: at most
  // that many), or the full mesh if `vertices` >= MaxVertices().
  virtual PointCloud RestMesh(int vertices) const = 0;

  // Return the largest number of vertices that RestMesh() makes, and the smallest number that still
  // shows the tissue.
  virtual int MaxVertices() const = 0;
  virtual int MinVertices() const = 0;

  // Returns the part of the tissue at rest that may be in the picture in `frame`. Its mesh is so
  // fine that the triangles stay within the unit of the depth (0.1 mm) of the smooth surface.
  virtual PointCloud RestPatch(int frame) const = 0;

  // Returns the position in `frame` of the tissue point that is at `rest` in frame 0.
  virtual Eigen::Vector3d Deform(int frame, const Eigen::Vector3d& rest) const = 0;

  // Returns the pose of the camera in `frame`.
  virtual CameraPose WorldFromCamera(int frame) const = 0;

  // Returns the mask of the pixels that count in `frame`; an empty mask if all count.
  virtual MaskImage Mask(int /*frame*/) const { return {}; }
};

// Returns the pose of a camera at `eye` that looks at `target`. The direction `up`, which must not
// be parallel to the view, points upward in the picture.
CameraPose LookAt(const Eigen::Vector3d& eye,
                  const Eigen::Vector3d& target,
                  const Eigen::Vector3d& up);

// Returns a scene with an organ and a camera that moves around it; see SyntheticSequence.
// `vertices` >= 500, `frames` >= 1, `period` >= 2 frames.
std::unique_ptr<SyntheticScene> MakeOrganScene(SyntheticShape shape,
                                               int vertices,
                                               int frames,
                                               double period);

// Returns a scene with a sheet that is warped under a still camera; see SyntheticSequence.
std::unique_ptr<SyntheticScene> MakePlaneScene(int vertices,
                                               int frames,
                                               const PinholeCamera& camera);

// Returns the length of the part of the strip that one picture sees, in metres.
double StripViewLength(const PinholeCamera& camera);

// Returns a scene with a band of `length` >= StripViewLength(camera) metres, and a camera that
// moves along it from one end to the other; see SyntheticSequence.
std::unique_ptr<SyntheticScene> MakeStripScene(double length,
                                               int frames,
                                               double period,
                                               const PinholeCamera& camera);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SCENE_H_
