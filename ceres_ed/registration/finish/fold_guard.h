// Keeps a displacement from turning triangles over.
#ifndef CERES_ED_REGISTRATION_FINISH_FOLD_GUARD_H_
#define CERES_ED_REGISTRATION_FINISH_FOLD_GUARD_H_

#include <ceres_ed/geometry/welded_mesh.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Smooths, then shortens the way of the vertices from `start` to `points` around every triangle
// whose normal turns by more than about 78 degrees (cosine 0.2), or away from `normals` beyond
// that, or whose area changes by more than a factor of 10, until none is left. `normals`, one a
// vertex, are what the surface should have; triangles whose normal at `start` points away from them
// are folded and may turn. Returns how many vertices were held back.
int DampFolds(const WeldedMesh& mesh,
              const std::vector<Eigen::Vector3d>& start,
              const std::vector<Eigen::Vector3d>& normals,
              std::vector<Eigen::Vector3d>* points);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_FOLD_GUARD_H_
