// Keeps a displacement from turning triangles over.
#ifndef CERES_ED_REGISTRATION_FOLD_GUARD_H_
#define CERES_ED_REGISTRATION_FOLD_GUARD_H_

#include <ceres_ed/registration/finish_mesh.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Smooths, then shortens the way of the vertices from `start` to `points` around every triangle
// whose normal turns by more than about 78 degrees (cosine 0.2), or whose area changes by more than
// a factor of 10, until none is left. Triangles that are folded at `start` may turn: those whose
// normal points away from `normals`, one a vertex of what the surface should look like. Returns how
// many vertices were damped.
int DampFolds(const FinishMesh& mesh,
              const std::vector<Eigen::Vector3d>& start,
              const std::vector<Eigen::Vector3d>& normals,
              std::vector<Eigen::Vector3d>* points);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FOLD_GUARD_H_
