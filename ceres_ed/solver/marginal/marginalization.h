// Exact marginalisation of nodes (Eq. 18 to 21).
#ifndef CERES_ED_SOLVER_MARGINAL_MARGINALIZATION_H_
#define CERES_ED_SOLVER_MARGINAL_MARGINALIZATION_H_

#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <cost_functions/quadratic_cost.h>

namespace ceres_ed {

// Eliminates nodes f from the linearised energy. Of the residuals that touch them, only their
// minimum over f is left: a quadratic prior on the seam s, the nodes that share a residual with
// them. With Lambda = J^T J and g = J^T r of these residuals, both corrected for the losses:
//   prior(x_s) = min over x_f = c + (g_s - Lambda_sf Lambda_ff^-1 g_f)^T d
//                + d^T (Lambda_ss - Lambda_sf Lambda_ff^-1 Lambda_fs) d / 2,  d = x_s - x_s0
// and what the eliminated nodes make of any x_s follows by back-substitution (Eq. 21):
//   x_f = x_f0 - Lambda_ff^-1 (g_f + Lambda_fs d)
//
// Nothing is formed that has a column for each unknown of the seam: Lambda is factorised with the
// seam's blocks last, and the factor ends in that of the prior.
//
// Order of calls: SetProblem; Linearize; Eliminate; then prior and back-substitution as often as
// wanted. Update moves the linearisation point and keeps the factor.
class Marginalization {
 public:
  // Takes the residuals that touch the variable nodes of `config`, the nodes to eliminate. Its
  // eliminated nodes and extra residuals are those of an earlier elimination, if any: a prior is a
  // residual like any other. Keeps structure and symbolic factor where the residuals join the same
  // nodes as before, and the factor, for Update, where they have the same weights and losses, too.
  // The builder must outlive what follows.
  // Error: a residual joins a node to the camera.
  Status SetProblem(const ProblemBuilder& builder, const ProblemConfig& config);

  // Ascending. Nodes that no residual touches are left out: nothing says where they go.
  const std::vector<int>& eliminated_nodes() const { return eliminated_; }
  const std::vector<int>& seam_nodes() const { return seam_; }

  // Works out Lambda and g at `state`. False, and a factor that was there is lost, when a residual
  // can't be evaluated.
  bool Linearize(const DeformationState& state, int num_threads);

  // Factorises what Linearize has left, with `damping` >= 0 times the diagonal of Lambda_ff added
  // to it (Levenberg and Marquardt). False when that isn't positive definite.
  bool Eliminate(double damping);

  // Whether there is a factor over the present nodes.
  bool has_factor() const { return has_factor_; }
  double damping() const { return damping_; }
  // Factorisations so far.
  int num_eliminations() const { return num_eliminations_; }
  // Whether the factor is that of the last linearisation and not of an earlier one.
  bool is_fresh() const { return is_fresh_; }

  // Moves the linearisation point to `state` and works out energy and g anew, of the residuals as
  // they are now; Lambda and its factor stay. False when a residual can't be evaluated; the prior
  // is then as it was. There must be a factor.
  bool Update(const DeformationState& state, int num_threads);

  // The largest change of an entry of A_j since Lambda was worked out, over the eliminated nodes.
  // E_rot is quadratic in A_j, and t_j enters no built-in prior but linearly: this is what Lambda
  // depends on.
  double LargestChange(const DeformationState& state) const;

  // Of the residuals, not linearised, at the linearisation point.
  double energy() const { return energy_; }
  // The same at any state; false when a residual can't be evaluated.
  bool EvaluateEnergy(const DeformationState& state, int num_threads, double* energy) const;

  // Largest entry of g_f.
  double LargestGradient() const;

  // On the seam nodes, in their order. Changes with Eliminate and Update; one object as long as the
  // seam is the same.
  const QuadraticCost& prior() const { return *prior_; }
  // It, as a residual for a problem without the eliminated nodes.
  ExtraResidual PriorResidual() const;
  // Its value at a state.
  double PriorValue(const DeformationState& state) const;

  // Puts the eliminated nodes where the linearised energy is least for the seam of `state`.
  void BackSubstitute(DeformationState* state) const;

 private:
  // How the residuals of a term are weighed.
  struct Weighing {
    int term = -1;
    double sum = 0.0;
    LossSpec loss;
    bool operator==(const Weighing& other) const;
  };

  static std::vector<Weighing> WeighingsOf(const ProblemBuilder& builder,
                                           const std::vector<SelectedResidual>& residuals);
  int num_eliminated_rows() const;
  Eigen::VectorXd SeamDifference(const DeformationState& state) const;
  void UpdateStructure();
  // The prior's gradient and constant, from energy_ and gradient_.
  Eigen::VectorXd ReduceGradient(double* constant);

  ProblemConfig config_;
  std::vector<int> eliminated_;
  std::vector<int> seam_;
  std::unique_ptr<NormalEquations> equations_;
  std::vector<BlockPair> pairs_;
  std::vector<Weighing> weighings_;
  std::unique_ptr<BlockStructure> structure_;
  // Solving uses its work space.
  std::unique_ptr<BlockCholesky> cholesky_;

  // Of the linearisation: eliminated nodes first, then the seam.
  double energy_ = 0.0;
  std::vector<double> values_;
  Eigen::VectorXd gradient_;
  // Unknowns at the linearisation point, and where Lambda was worked out.
  Eigen::VectorXd origin_;
  Eigen::VectorXd factor_origin_;
  bool has_values_ = false;

  bool has_factor_ = false;
  bool is_fresh_ = false;
  double damping_ = 0.0;
  int num_eliminations_ = 0;
  // The seam's part of the factor, of the prior's Hessian plus `shift_` on its diagonal.
  Eigen::MatrixXd seam_factor_;
  double shift_ = 0.0;
  // L^-1 g.
  Eigen::VectorXd reduced_gradient_;
  std::unique_ptr<QuadraticCost> prior_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_MARGINAL_MARGINALIZATION_H_
