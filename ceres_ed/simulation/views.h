// What a camera sees of a mesh, and noise.
#ifndef CERES_ED_SIMULATION_VIEWS_H_
#define CERES_ED_SIMULATION_VIEWS_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A pinhole camera without a pixel grid, or parallel rays.
struct SyntheticView {
  // The pinhole, in the frame and unit of the mesh. With parallel rays only the direction from
  // here to `look_at` counts.
  Eigen::Vector3d eye = Eigen::Vector3d(0.0, 0.0, 1.0);
  Eigen::Vector3d look_at = Eigen::Vector3d::Zero();
  bool parallel = false;
  // Pinhole only: points farther off the axis are out of the picture; degrees, (0, 89].
  double half_angle_deg = 60.0;
};

// Returns for each vertex 1 if `view` sees it, else 0: it lies in the picture, at least one of its
// triangles faces the camera, and no other triangle cuts its ray. Exact, not by pixels. With a
// pinhole, triangles that reach behind the camera hide nothing.
std::vector<char> VisibleVertices(const PointCloud& mesh, const SyntheticView& view);

// Returns the triangles of `mesh` that face the camera with all three corners visible, re-indexed
// in the old order; vertices without such a triangle are left out. Where `kept` is given it gets
// the old index of each new vertex.
PointCloud VisiblePart(const PointCloud& mesh,
                       const SyntheticView& view,
                       std::vector<int>* kept = nullptr);

// Adds independent Gaussian noise of deviation `sigma` >= 0 (unit of the cloud) to each coordinate.
void AddSyntheticNoise(double sigma, std::uint64_t seed, PointCloud* cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_VIEWS_H_
