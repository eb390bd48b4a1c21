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

// Eliminates nodes f from the linearised energy. The residuals that touch these nodes are replaced
// by their minimum over f. This minimum is a quadratic prior on the boundary s, which are the other
// nodes of these residuals. With Lambda = J^T J and g = J^T r of these residuals, both corrected
// for the losses,
//   prior(x_s) = min over x_f = c + (g_s - Lambda_sf Lambda_ff^-1 g_f)^T d
//                + d^T (Lambda_ss - Lambda_sf Lambda_ff^-1 Lambda_fs) d / 2,  d = x_s - x_s0.
// For any x_s, the eliminated nodes follow by back-substitution (Eq. 21):
//   x_f = x_f0 - Lambda_ff^-1 (g_f + Lambda_fs d)
//
// No matrix is formed that has a column for each unknown of the boundary: Lambda is factorised with
// the blocks of the boundary last, so that the factor ends with the factor of the prior.
//
// Call SetProblem(), then Linearize(), then Eliminate(); after that the prior and the
// back-substitution may be used any number of times. Update() moves the linearisation point and
// keeps the factor.
class Marginalization {
 public:
  // Takes the residuals that touch the variable nodes of `config`, which are the nodes to
  // eliminate. The eliminated nodes and extra residuals of `config` are those of an earlier
  // elimination, if there was one: a prior is a residual like any other. The structure and the
  // symbolic factor are kept if the residuals couple the same nodes as before. If they also have
  // the same weights and losses, the factor is kept for Update(). The builder must outlive the
  // following calls. It is an error if a residual couples a node to the camera.
  Status SetProblem(const ProblemBuilder& builder, const ProblemConfig& config);

  // Return the eliminated nodes and the nodes of the boundary, in ascending order. Nodes that no
  // residual touches are left out, because nothing determines them.
  const std::vector<int>& eliminated_nodes() const { return eliminated_; }
  const std::vector<int>& boundary_nodes() const { return boundary_; }

  // Computes Lambda and g at `state`. Returns false if a residual cannot be evaluated. In both
  // cases the previous factor is lost.
  bool Linearize(const DeformationState& state, int num_threads);

  // Factorises the result of Linearize(), with `damping` >= 0 times the diagonal of Lambda_ff added
  // to it (Levenberg and Marquardt). Returns false if the matrix is not positive definite.
  bool Eliminate(double damping);

  // Returns whether there is a factor for the present nodes.
  bool has_factor() const { return has_factor_; }
  // Returns the damping of the last elimination.
  double damping() const { return damping_; }
  // Returns the number of factorisations so far.
  int num_eliminations() const { return num_eliminations_; }
  // Returns whether the factor belongs to the last linearisation, and not to an earlier one.
  bool is_fresh() const { return is_fresh_; }

  // Moves the linearisation point to `state` and computes the energy and g of the present
  // residuals; Lambda and its factor do not change. Returns false if a residual cannot be
  // evaluated; the prior is then unchanged. There must be a factor.
  bool Update(const DeformationState& state, int num_threads);

  // Returns the largest change of an entry of A_j, over the eliminated nodes, since Lambda was
  // computed. Lambda depends on these changes only: E_rot is not linear in A_j, whereas t_j enters
  // all built-in priors linearly.
  double LargestChange(const DeformationState& state) const;

  // Returns the energy of the residuals themselves, not linearised, at the linearisation point.
  double energy() const { return energy_; }
  // Computes the same energy at any state. Returns false if a residual cannot be evaluated.
  bool EvaluateEnergy(const DeformationState& state, int num_threads, double* energy) const;

  // Returns the largest absolute entry of g_f.
  double LargestGradient() const;

  // Returns the prior on the boundary nodes, in their order. Eliminate() and Update() change it;
  // the object remains the same as long as the boundary is the same.
  const QuadraticCost& prior() const { return *prior_; }
  // Returns the prior as a residual for a problem without the eliminated nodes.
  ExtraResidual PriorResidual() const;
  // Returns the value of the prior at a state.
  double PriorValue(const DeformationState& state) const;

  // Moves the eliminated nodes to the minimum of the linearised energy for the boundary of `state`.
  void BackSubstitute(DeformationState* state) const;

 private:
  // The weights and the loss of the residuals of one term.
  struct Weighing {
    int term = -1;
    double sum = 0.0;
    LossSpec loss;
    bool operator==(const Weighing& other) const;
  };

  static std::vector<Weighing> WeighingsOf(const ProblemBuilder& builder,
                                           const std::vector<SelectedResidual>& residuals);
  int num_eliminated_rows() const;
  Eigen::VectorXd BoundaryDifference(const DeformationState& state) const;
  void UpdateStructure();
  // Computes the gradient and the constant of the prior from energy_ and gradient_.
  Eigen::VectorXd ReduceGradient(double* constant);

  ProblemConfig config_;
  std::vector<int> eliminated_;
  std::vector<int> boundary_;
  std::unique_ptr<NormalEquations> equations_;
  std::vector<BlockPair> pairs_;
  std::vector<Weighing> weighings_;
  std::unique_ptr<BlockStructure> structure_;
  // The factor also contains the memory in which systems are solved.
  std::unique_ptr<BlockCholesky> cholesky_;

  // The linearisation: eliminated nodes first, then the boundary.
  double energy_ = 0.0;
  std::vector<double> values_;
  Eigen::VectorXd gradient_;
  // The unknowns at the linearisation point, and at the point where Lambda was computed.
  Eigen::VectorXd origin_;
  Eigen::VectorXd factor_origin_;
  bool has_values_ = false;

  bool has_factor_ = false;
  bool is_fresh_ = false;
  double damping_ = 0.0;
  int num_eliminations_ = 0;
  // The boundary's part of the factor. It is the factor of the prior's Hessian plus `shift_` on its
  // diagonal.
  Eigen::MatrixXd boundary_factor_;
  double shift_ = 0.0;
  // L^-1 g.
  Eigen::VectorXd reduced_gradient_;
  std::unique_ptr<QuadraticCost> prior_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_MARGINAL_MARGINALIZATION_H_
