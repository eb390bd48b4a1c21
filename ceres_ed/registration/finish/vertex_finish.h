// The last step of a fit: a smooth displacement of every vertex onto the target.
#ifndef CERES_ED_REGISTRATION_FINISH_VERTEX_FINISH_H_
#define CERES_ED_REGISTRATION_FINISH_VERTEX_FINISH_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/registration/matching.h>
#include <ceres_ed/registration/unit_fit.h>

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the noise for which a finish should allow, in the unit of the surfaces: the noise of the
// target beyond the roughness that it shares with the source.
double FinishNoise(const Surface& source, const Surface& target);

// The input of a finish, all in one frame and unit. The pointers must outlive the call.
struct FinishInput {
  // The source at rest; only its triangles and borders are used.
  const Surface* source = nullptr;
  // The source's present points and normals.
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const std::vector<Eigen::Vector3d>* normals = nullptr;
  const Surface* target = nullptr;
  // The standard deviation of the target's noise across its surface, >= 0.
  double noise = 0.0;
  // Points that end near given positions, and points that do not move at all.
  std::vector<Correspondence> landmarks;
  std::vector<Correspondence> fixed;
  MatchingOptions matching;
  // The fit whose own energies (FitOptions::extra_energies) the finish also obeys; null: there are
  // none.
  const UnitFit* fit = nullptr;
  // Called often; if it returns true, nothing is moved.
  std::function<bool()> should_stop;
  // Called with the part of the finish that is done, in [0, 1].
  std::function<void(double)> on_progress;
};

// The result of a finish.
struct FinishResult {
  // One point for each point of the source. Points at the same position move by the same
  // displacement.
  std::vector<Eigen::Vector3d> points;
  // False if the noise is too large for a finish, or if it was stopped; `points` are then those of
  // the input.
  bool moved = false;
  // The smoothing that was used.
  double smoothing = 0.0;
  // The number of pairs of the last round, and their root mean square distances at the end.
  int pairs = 0;
  double rms_plane = 0.0;
  double rms_point = 0.0;
};

// Returns the source's points displaced onto the target. It minimises, over the displacements d,
//   sum_k w_k [(1 - s) (n_k . r_k)^2 + s |r_k|^2] + lambda sum_v deg_v |d_v - mean of neighbours|^2
//     + eps |d|^2
// plus the energies of the user on the vertices (OwnEnergies),
// with pairs k in both directions (FinishMatcher), r_k the vector from the target of a pair to the
// blend of its vertices, and lambda and eps from the lengths in `options`. Each step solves a
// system with a matrix that majorises the Hessian and is the same for x, y and z: diag(sum_k w_k
// blend_k) + lambda B + eps (FinishSystem). It is set up once per round. At the end displacements
// are damped around every triangle that they would turn over, or squeeze or stretch too much.
//
// With noise sigma, and s the robust deviation of the distances beyond the noise, the smoothing is
// at least 3 sigma / s: the averaging then reduces the noise to a twelfth of the possible gain. The
// result is deterministic and uses one thread.
FinishResult FinishVertices(const FinishInput& input, const FinishOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_VERTEX_FINISH_H_
