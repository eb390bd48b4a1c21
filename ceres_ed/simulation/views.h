// Computes what a camera sees of a mesh, and adds noise.
#ifndef CERES_ED_SIMULATION_VIEWS_H_
#define CERES_ED_SIMULATION_VIEWS_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A pinhole camera without a pixel grid, or a view along parallel rays.
struct SyntheticView {
  // The position of the pinhole, in the frame and unit of the mesh. For parallel rays only the
  // direction from here to `look_at` counts.
  Eigen::Vector3d eye = Eigen::Vector3d(0.0, 0.0, 1.0);
  Eigen::Vector3d look_at = Eigen::Vector3d::Zero();
  bool parallel = false;
  // Pinhole only: points farther from the axis than this are outside the picture; degrees, (0, 89].
  double half_angle_deg = 60.0;
};

// Returns 1 for each vertex that `view` sees, else 0. A vertex is visible if it lies in the
// picture, at least one of its triangles faces the camera, and no other triangle intersects its
// ray. The test is exact and uses no pixels. With a pinhole, triangles that extend behind the
// camera hide nothing.
std::vector<char> VisibleVertices(const PointCloud& mesh, const SyntheticView& view);

// Returns the triangles of `mesh` that face the camera and have three visible corners, with
// vertices renumbered in the old order. Vertices without such a triangle are left out. If `kept` is
// not null, it receives the old index of each new vertex.
PointCloud VisiblePart(const PointCloud& mesh,
                       const SyntheticView& view,
                       std::vector<int>* kept = nullptr);

// Adds independent Gaussian noise with the standard deviation `sigma` >= 0 (in the unit of the
// cloud) to each coordinate.
void AddSyntheticNoise(double sigma, std::uint64_t seed, PointCloud* cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_VIEWS_H_
