// The true surface of a frame, and material points on it.
#ifndef CERES_ED_EVALUATION_TRUE_SURFACE_H_
#define CERES_ED_EVALUATION_TRUE_SURFACE_H_

#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/point_cloud.h>

#include <Eigen/Core>

namespace ceres_ed {

// A material point of the tissue, which moves with the tissue.
struct TissuePoint {
  // The triangle, or -1 if the point is unknown.
  int triangle = -1;
  // The barycentric weights of the triangle's corners.
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();

  bool known() const { return triangle >= 0; }
};

// The true surface in one frame. It cannot be moved in memory, because its search tree refers to
// it.
class TrueSurface {
 public:
  // `mesh` must have at least one triangle.
  explicit TrueSurface(PointCloud mesh);
  TrueSurface(const TrueSurface&) = delete;
  TrueSurface& operator=(const TrueSurface&) = delete;

  const PointCloud& mesh() const { return mesh_; }

  // Returns the exact distance of `point` to the triangles.
  double Distance(const Eigen::Vector3d& point) const;

  // Returns the tissue point closest to `point`, or an unknown one if it is farther than
  // `max_distance`.
  TissuePoint Locate(const Eigen::Vector3d& point, double max_distance) const;

  // Returns the position of a known tissue point in this frame.
  Eigen::Vector3d PlaceOf(const TissuePoint& tissue) const;

 private:
  PointCloud mesh_;
  SurfaceIndex index_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_TRUE_SURFACE_H_
