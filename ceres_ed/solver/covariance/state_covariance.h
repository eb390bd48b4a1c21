// Computes how well a state is determined by the residuals that it minimises.
#ifndef CERES_ED_SOLVER_COVARIANCE_STATE_COVARIANCE_H_
#define CERES_ED_SOLVER_COVARIANCE_STATE_COVARIANCE_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Options of StateCovariance::Compute().
struct CovarianceOptions {
  // Bindings of points for which Point() will be called. The results are exact for all points, and
  // faster for these. Only Compute() reads them. Default: none.
  const Skinning* skinning = nullptr;
  // Number of threads, >= 1, default 1. The result does not depend on it.
  int num_threads = 1;
};

// What the residuals determine about a node or the camera.
enum class ParameterStatus {
  // The residuals determine it.
  kDetermined,
  // It is not variable and therefore known, with zero variance.
  kHeld,
  // A change in some direction changes no residual, alone or together with other parameters:
  // nothing observes it and no prior determines it, or the whole problem can move as one (a free
  // gauge).
  kUndetermined,
  // It is not part of this problem (ProblemConfig::eliminated_nodes).
  kEliminated,
};

// (J^T J)^-1 of a problem at a state, where J is the Gauss-Newton Jacobian of its residuals:
// multiplied by the square roots of their weights, and corrected for their losses as in Ceres. It
// equals the result of ceres::Covariance where that exists.
//
// It is the covariance of the state under two assumptions: every weighted residual, also of priors,
// has variance 1 and is independent of the others; and the problem is linear around the state over
// the range of the deviations.
class StateCovariance {
 public:
  // Returns the covariance for the problem of `config` at `state`, which should be a minimum of the
  // problem. It is an error if a residual cannot be evaluated; the builder names it. A problem
  // without full rank is not an error. The builder's graph must outlive the result.
  static StatusOr<StateCovariance> Compute(const ProblemBuilder& builder,
                                           const ProblemConfig& config,
                                           const DeformationState& state,
                                           const CovarianceOptions& options = {});

  StateCovariance(StateCovariance&&) noexcept;
  StateCovariance& operator=(StateCovariance&&) noexcept;
  ~StateCovariance();

  // Returns what the residuals determine about a node.
  ParameterStatus status(int node) const;
  // Returns the same for the camera; kHeld if there is no camera.
  ParameterStatus camera_status() const;
  // Returns the nodes that are kUndetermined, in ascending order.
  const std::vector<int>& undetermined() const;

  // All functions below return NaN if one of the parameters involved is undetermined or eliminated,
  // and zero if all of them are held. They may be called from several threads at once.

  // Returns the covariance of a node, 12 x 12, in the order of cost_functions/node_parameters.h.
  Eigen::MatrixXd Node(int node) const;

  // Returns the covariance of the camera, 6 x 6: the rotation in the tangent space of
  // ceres::EigenQuaternionManifold (half a rotation vector, in the camera frame), then the
  // translation.
  Eigen::MatrixXd Camera() const;

  // Returns the covariance of the warped point of `position` (Eq. 1 without the camera) in the map
  // frame, in squared map units. `binding` is the binding of the point at rest.
  Eigen::Matrix3d Point(const Eigen::Vector3d& position, const Binding& binding) const;

  // Returns the covariance of the point in the camera frame, including the contribution of the
  // camera.
  Eigen::Matrix3d PointInCamera(const Eigen::Vector3d& position, const Binding& binding) const;

  // Returns the changes of all nodes, 12 for each, that `force` (12 values for each node, those of
  // a gradient) causes: (J^T J)^-1 force. They are zero for nodes that are not variable. Unlike the
  // functions above, it gives undetermined nodes what a tiny regulariser lets them do.
  Eigen::VectorXd SolveNodes(const Eigen::VectorXd& force) const;

 private:
  struct Impl;
  explicit StateCovariance(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_COVARIANCE_STATE_COVARIANCE_H_
