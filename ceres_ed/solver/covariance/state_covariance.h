// How well a state is determined by the residuals that it minimises.
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

struct CovarianceOptions {
  // Bindings of points that Point() will be asked for: fast for these, exact for all. Looked at by
  // Compute() alone.
  const Skinning* skinning = nullptr;
  // The result doesn't depend on it, >= 1.
  int num_threads = 1;
};

// What the residuals say about a node or the camera.
enum class ParameterStatus {
  kDetermined,
  // Not variable: known, with no variance.
  kHeld,
  // Some direction of it changes no residual, alone or together with others: nothing observes it
  // and no prior holds it, or all of the problem may move as one (a free gauge).
  kUndetermined,
  // Not of this problem (ProblemConfig::eliminated_nodes).
  kEliminated,
};

// (J^T J)^-1 of a problem at a state, with J the Jacobian of its residuals as Gauss-Newton has it:
// times the roots of their weights, corrected for their losses as Ceres does. It equals that of
// ceres::Covariance where that exists.
//
// It is the covariance of the state when every weighted residual has variance 1 and is independent
// of the others, priors among them, and when the problem is linear about the state for as far as
// its deviations go. Where the weights are right up to a common factor, multiply by an estimate of
// the variance factor (solver/covariance/variance_factor.h).
class StateCovariance {
 public:
  // The problem of `config` at `state`, which should be a minimum of it. Error: a residual that
  // can't be evaluated, named by the builder. A problem without full rank is none.
  // The builder's graph must outlive the result.
  static StatusOr<StateCovariance> Compute(const ProblemBuilder& builder,
                                           const ProblemConfig& config,
                                           const DeformationState& state,
                                           const CovarianceOptions& options = {});

  StateCovariance(StateCovariance&&) noexcept;
  StateCovariance& operator=(StateCovariance&&) noexcept;
  ~StateCovariance();

  ParameterStatus status(int node) const;
  // kHeld where there is no camera.
  ParameterStatus camera_status() const;
  // Nodes that are kUndetermined, ascending.
  const std::vector<int>& undetermined() const;

  // All functions below: NaN where one of the parameters that matter is undetermined or eliminated,
  // zero where all are held. From several threads at once, too.

  // 12 x 12, in the order of cost_functions/node_parameters.h.
  Eigen::MatrixXd Node(int node) const;

  // 6 x 6: rotation in the tangent space of ceres::EigenQuaternionManifold (a rotation vector's
  // half, in the camera frame), then translation.
  Eigen::MatrixXd Camera() const;

  // Of the warped point of `position` (Eq. 1 without the camera), map frame, squared map units.
  // `binding` is that of the point at rest.
  Eigen::Matrix3d Point(const Eigen::Vector3d& position, const Binding& binding) const;

  // The same in the camera frame, with what the camera adds.
  Eigen::Matrix3d PointInCamera(const Eigen::Vector3d& position, const Binding& binding) const;

  // J (J^T J)^-1 J^T of one residual, as the problem weighs it at this state: the covariance of
  // what the state predicts for it, whose trace is how many parameters the residual is worth. Held
  // blocks add nothing. False when its cost function fails.
  bool Residual(const SelectedResidual& residual,
                const LossSpec& loss,
                Eigen::MatrixXd* covariance) const;

 private:
  struct Impl;
  explicit StateCovariance(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_COVARIANCE_STATE_COVARIANCE_H_
