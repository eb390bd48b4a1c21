// The true surface of a frame, and places on it.
#ifndef CERES_ED_EVALUATION_TRUE_SURFACE_H_
#define CERES_ED_EVALUATION_TRUE_SURFACE_H_

#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/point_cloud.h>

#include <Eigen/Core>

namespace ceres_ed {

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

#endif  // CERES_ED_EVALUATION_TRUE_SURFACE_H_
