// Limits a displacement so that it does not turn triangles over.
#ifndef CERES_ED_REGISTRATION_FINISH_FOLD_GUARD_H_
#define CERES_ED_REGISTRATION_FINISH_FOLD_GUARD_H_

#include <ceres_ed/geometry/welded_mesh.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Smooths and then shortens the displacement of vertices from `start` to `points` around bad
// triangles, until there are none. A triangle is bad if its normal turns by more than about 78
// degrees (cosine 0.2), if its normal turns away from `normals` to beyond this angle, or if its
// area changes by more than a factor of 10. `normals`, one per vertex, are the normals that the
// surface should have. Triangles whose normal at `start` points against them are folded and may
// turn. Returns the number of vertices whose displacement was limited.
int DampFolds(const WeldedMesh& mesh,
              const std::vector<Eigen::Vector3d>& start,
              const std::vector<Eigen::Vector3d>& normals,
              std::vector<Eigen::Vector3d>* points);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_FOLD_GUARD_H_
