// The last step of a fit: a smooth displacement of every vertex onto the target.
#ifndef CERES_ED_REGISTRATION_FINISH_VERTEX_FINISH_H_
#define CERES_ED_REGISTRATION_FINISH_VERTEX_FINISH_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/registration/matching.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The noise that a finish should reckon with, in the unit of the surfaces: that of the target
// beyond what roughness it shares with a source that is smooth but for its shape.
double FinishNoise(const Surface& source, const Surface& target);

// What is finished; all in one frame and unit. The pointers must outlive the call.
struct FinishInput {
  // At rest: for its triangles and borders alone.
  const Surface* source = nullptr;
  // The source's points and normals as they are now.
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const std::vector<Eigen::Vector3d>* normals = nullptr;
  const Surface* target = nullptr;
  // Standard deviation of the target's noise across its surface, >= 0.
  double noise = 0.0;
  // Points that end near their places, and points that aren't moved at all.
  std::vector<Correspondence> landmarks;
  std::vector<Correspondence> fixed;
  MatchingOptions matching;
};

struct FinishResult {
  // One a point of the source; points at the same position move alike.
  std::vector<Eigen::Vector3d> points;
  // False where there was nothing to gain against the noise: `points` are those of the input.
  bool moved = false;
  // What `smoothing` came to.
  double smoothing = 0.0;
  // Pairs of the last round, and their root mean square distances at the end.
  int pairs = 0;
  double rms_plane = 0.0;
  double rms_point = 0.0;
};

// Returns the source's points displaced onto the target. Minimises over the displacements d
//   sum_k w_k [(1 - s) (n_k . r_k)^2 + s |r_k|^2] + lambda sum_v deg_v |d_v - mean of neighbours|^2
//     + eps |d|^2
// with pairs k both ways (FinishMatcher), r_k the vector from a pair's target to the blend of its
// vertices, lambda and eps from the lengths of `options`. Each step solves with a matrix that
// majorises the Hessian and is the same for x, y and z: diag(sum_k w_k blend_k) + lambda B + eps;
// it is factorised once a round. In the end displacements are damped around every triangle that
// they would turn over, or squeeze or stretch beyond reason.
//
// With noise sigma, and s the robust deviation of the distances beyond it, the smoothing is at
// least 3 sigma / s: the average then brings the noise to a twelfth of what there is to gain.
// Deterministic; one thread.
FinishResult FinishVertices(const FinishInput& input, const FinishOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_VERTEX_FINISH_H_
