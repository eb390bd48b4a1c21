// Lays faces flat again that a deformation has folded over.
#ifndef CERES_ED_REGISTRATION_FINISH_UNFOLD_H_
#define CERES_ED_REGISTRATION_FINISH_UNFOLD_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/geometry/welded_mesh.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// What is unfolded; all in one frame and unit. The pointers must outlive the call.
struct UnfoldInput {
  const WeldedMesh* mesh = nullptr;
  // One point a vertex, as those that are unfolded.
  const std::vector<Eigen::Vector3d>* rest = nullptr;
  // Vertices that don't move.
  std::vector<int> held;
  // What the points have been fitted to; may be null.
  const Surface* target = nullptr;
};

// Counts of folded faces (FoldFinder says which are).
struct UnfoldResult {
  int before = 0;
  int after = 0;
};

// Moves vertices of `points` around folded faces until none is left, or as few as can be. Around
// each fold the vertices within some rings are set free and relaxed as rigidly as possible (Sorkine
// and Alexa 2007, uniform weights) with all else in its place: from where they are, then with the
// rotations of the patch's rim spread over it. Vertices that are near the target are drawn to its
// closest point; where a fold stays, less, and at last not at all. The first patch that leaves no
// fold is taken, the smaller before the larger; else the one that leaves fewest, and none where
// none leaves fewer than there were.
//
// Nothing else moves, not by a bit. Bare points have no faces to fold. Deterministic; one thread.
UnfoldResult UnfoldFaces(const UnfoldInput& input, std::vector<Eigen::Vector3d>* points);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_UNFOLD_H_
