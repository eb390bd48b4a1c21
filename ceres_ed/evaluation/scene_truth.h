// Where the tissue and the camera of a sequence truly are.
#ifndef CERES_ED_EVALUATION_SCENE_TRUTH_H_
#define CERES_ED_EVALUATION_SCENE_TRUTH_H_

#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/deformation_state.h>

#include <array>
#include <map>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// One mesh that moves, and the camera that looks at it.
struct SceneTruth {
  std::vector<std::array<int, 3>> triangles;
  int num_vertices = 0;
  // World frame, metres: x y z of every vertex of frame 0, then of frame 1, and so on.
  std::vector<float> vertices;
  // point_in_world = world_from_camera * point_in_camera, by frame.
  std::map<int, CameraPose> world_from_camera;

  int num_frames() const;
  // Whether both the mesh and the camera of `frame` are known.
  bool Has(int frame) const;
  // The mesh in the camera frame of `frame`; CHECKs Has(frame).
  PointCloud InCamera(int frame) const;
};

// A place on the tissue that stays the same however the tissue moves.
struct TissuePoint {
  // -1: unknown.
  int triangle = -1;
  // Weights of its corners.
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();

  bool known() const { return triangle >= 0; }
};

// The true surface in one frame; it stands still in memory, for its search tree refers to it.
class TrueSurface {
 public:
  // A mesh with at least one triangle.
  explicit TrueSurface(PointCloud mesh);
  TrueSurface(const TrueSurface&) = delete;
  TrueSurface& operator=(const TrueSurface&) = delete;

  const PointCloud& mesh() const { return mesh_; }

  // The exact distance to the triangles.
  double Distance(const Eigen::Vector3d& point) const;

  // The tissue point closest to `point`; unknown when it is farther than `max_distance`.
  TissuePoint Locate(const Eigen::Vector3d& point, double max_distance) const;

  // Where a known tissue point is in this frame.
  Eigen::Vector3d PlaceOf(const TissuePoint& tissue) const;

 private:
  PointCloud mesh_;
  SurfaceIndex index_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_SCENE_TRUTH_H_
