// Lays faces flat that a deformation has folded over.
#ifndef CERES_ED_REGISTRATION_FINISH_UNFOLD_H_
#define CERES_ED_REGISTRATION_FINISH_UNFOLD_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/geometry/welded_mesh.h>

#include <functional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The input of an unfolding, all in one frame and unit. The pointers must outlive the call.
struct UnfoldInput {
  const WeldedMesh* mesh = nullptr;
  // The shape at rest, with one point per vertex like the points to unfold.
  const std::vector<Eigen::Vector3d>* rest = nullptr;
  // The vertices that do not move.
  std::vector<int> held;
  // The surface to which the points have been fitted; may be null.
  const Surface* target = nullptr;
  // Called often; if it returns true, the remaining folds stay.
  std::function<bool()> should_stop;
};

// The number of folded faces before and after (by the rules of FoldFinder).
struct UnfoldResult {
  int before = 0;
  int after = 0;
};

// Moves vertices of `points` around folded faces until none is folded, or as few as possible.
//
// Around each fold the vertices within some rings are relaxed as rigidly as possible (Sorkine and
// Alexa 2007, uniform weights), while all others keep their positions. The relaxation starts from
// the present positions, and then also with the rotations of the patch's rim interpolated over the
// patch. Vertices near the target are attracted to its closest point; if a fold remains, the
// attraction is reduced and finally removed. Smaller patches are tried before larger ones. The
// first patch without a fold is used, or else the one with the fewest folds, provided that it has
// fewer than before.
//
// No other vertex moves, not by a single bit. Bare points have no faces, so nothing happens. The
// result is deterministic and uses one thread.
UnfoldResult UnfoldFaces(const UnfoldInput& input, std::vector<Eigen::Vector3d>* points);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_UNFOLD_H_
