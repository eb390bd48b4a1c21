// The Gauss-Newton normal equations of a subproblem, assembled in blocks.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/block_structure.h>
#include <ceres_ed/solver/point_linearization.h>

#include <memory>
#include <vector>

#include <Eigen/Core>
#include <ceres/loss_function.h>
#include <cost_functions/quadratic_cost.h>
#include <cost_functions/warped_point_cost.h>

namespace ceres_ed {

// Unknowns: one block of 12 a variable node, in the order of the nodes, then one of 6 for a
// variable camera (rotation in the tangent space of ceres::EigenQuaternionManifold, then
// translation). Builder and config must outlive this, and their residuals stay as they are.
class NormalEquations {
 public:
  NormalEquations(const ProblemBuilder& builder, const ProblemConfig& config);
  // Of some residuals of the builder alone, with the blocks in the order of `variable_nodes`; the
  // camera is held.
  NormalEquations(const ProblemBuilder& builder,
                  const std::vector<SelectedResidual>& residuals,
                  const std::vector<int>& variable_nodes);

  int num_variable_nodes() const { return static_cast<int>(variable_nodes_.size()); }
  bool camera_variable() const { return camera_variable_; }
  // Rows of each block.
  std::vector<int> BlockSizes() const;
  // Pairs of blocks that share a residual, by column and then row, without repetition.
  std::vector<BlockPair> BlockPairs() const;

  // Fixes where each residual's products go. `structure` outlives this. False, and nothing is
  // fixed, when it lacks one of BlockPairs(), or the affine part of one.
  bool SetStructure(const BlockStructure* structure);

  // Writes cost = sum of rho(|r|^2) / 2, values = J^T J in the layout of the structure (diagonal
  // blocks in full) and gradient = J^T r, with r and J corrected for the loss as Ceres does. False
  // when a cost function fails or returns something that isn't finite.
  bool Evaluate(const DeformationState& state,
                int num_threads,
                double* cost,
                std::vector<double>* values,
                Eigen::VectorXd* gradient) const;

  // The cost and its gradient.
  bool EvaluateGradient(const DeformationState& state,
                        int num_threads,
                        double* cost,
                        Eigen::VectorXd* gradient) const;

  // The cost alone.
  bool EvaluateCost(const DeformationState& state, int num_threads, double* cost) const;

  // state + delta, on the camera's manifold. `delta` has the layout of the unknowns.
  void Plus(const Eigen::VectorXd& delta, DeformationState* state) const;

  // The Euclidean norm of all variable parameters, as Ceres takes it for its tolerance.
  double ParameterNorm(const DeformationState& state) const;

 private:
  // A part of a residual's Jacobian: `width` columns from `column` go to rows `offset` on of
  // `block`.
  struct Part {
    int block = -1;
    int offset = 0;
    int width = 0;
    int column = 0;
    // Whether more than the translation of a node enters.
    bool affine = true;
  };
  // A residual block, or all those on one warped point: these share their blocks, and the products
  // of their Jacobians are added up by the point before they are spread over the nodes.
  struct Item {
    SelectedResidual residual;
    // Set where the cost functions are on a warped point: their Jacobian has a form of its own.
    const PointCostFunction* point = nullptr;
    // Set where it is a quadratic of nodes without a loss: the square of its Jacobian is known.
    const QuadraticCost* quadratic = nullptr;
    // The next residual on the same point, into more_; -1 behind the last one.
    int more = -1;
    int last_more = -1;
    int num_residuals = 0;
    int width = 0;
    int first_part = 0;
    int num_parts = 0;
    // Into entries_: num_parts * (num_parts + 1) / 2 entries of the structure.
    int first_entry = 0;

    // Doubles that the item's linearisation takes.
    int LinearizationSize() const;
  };
  // A further residual on the point of an item.
  struct PointResidual {
    const PointCostFunction* cost = nullptr;
    int term = -1;
    double weight = 1.0;
    int next = -1;
  };
  class PointTable;
  // Buffers of one thread. A linearisation is corrected for the loss; of a general item it is the
  // residuals, then the parts of the Jacobian one after the other, each row-major, and of a point
  // PointLinearization, and of a quadratic its gradient.
  struct Scratch {
    explicit Scratch(const NormalEquations& equations);

    std::vector<double> linearization;
    std::vector<double> residuals;
    // By a quaternion, or by a point.
    std::vector<double> derivative;
    std::vector<const double*> blocks;
    std::vector<double*> jacobians;
  };

  void AddItems(const ProblemBuilder& builder, const std::vector<SelectedResidual>& residuals);
  void AddItem(const SelectedResidual& residual,
               const std::vector<int>& block_of_node,
               PointTable* points);
  // Null where there is none.
  const ceres::LossFunction* Loss(int term) const {
    return term < 0 ? nullptr : losses_[term].get();
  }
  bool ApplyLoss(int term,
                 double weight,
                 int num_residuals,
                 const double* residuals,
                 double rho[3],
                 double* cost) const;
  bool EvaluateGeneral(const Item& item,
                       const DeformationState& state,
                       double* linearization,
                       Scratch* scratch,
                       double* cost) const;
  // One residual on a warped point, added to `linear` where that isn't null.
  bool AddPointResidual(const PointResidual& residual,
                        const Eigen::Vector3d& warped,
                        PointLinearization* linear,
                        Scratch* scratch,
                        double* cost) const;
  bool EvaluatePoint(const Item& item,
                     const DeformationState& state,
                     double* linearization,
                     Scratch* scratch,
                     double* cost) const;
  bool EvaluateQuadratic(const Item& item,
                         const DeformationState& state,
                         double* linearization,
                         Scratch* scratch,
                         double* cost) const;
  // `linearization` is null where the cost alone is wanted.
  bool EvaluateItem(const Item& item,
                    const DeformationState& state,
                    double* linearization,
                    Scratch* scratch,
                    double* cost) const;
  // What follows touches gradient rows of, and value columns of, blocks in [first, last) alone;
  // where `values` is null only the gradient is wanted.
  struct BlockRange {
    int first = 0;
    int last = 0;
    bool Has(int block) const { return block >= first && block < last; }
  };
  void AccumulateGeneral(const Item& item,
                         const double* linearization,
                         const BlockRange& range,
                         double* values,
                         double* gradient) const;
  void AccumulatePoint(const Item& item,
                       const double* linearization,
                       const BlockRange& range,
                       double* values,
                       double* gradient) const;
  void AccumulateQuadratic(const Item& item,
                           const double* linearization,
                           const BlockRange& range,
                           double* values,
                           double* gradient) const;
  void AccumulateCamera(const Item& item,
                        const double* linearization,
                        const BlockRange& range,
                        double* values,
                        double* gradient) const;
  void Accumulate(const Item& item,
                  const double* linearization,
                  const BlockRange& range,
                  double* values,
                  double* gradient) const;
  bool EvaluateSerial(const DeformationState& state,
                      double* cost,
                      std::vector<double>* values,
                      Eigen::VectorXd* gradient) const;
  bool EvaluateParallel(const DeformationState& state,
                        int num_threads,
                        double* cost,
                        std::vector<double>* values,
                        Eigen::VectorXd* gradient) const;

  std::vector<int> variable_nodes_;
  bool camera_variable_ = false;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;
  std::vector<Item> items_;
  std::vector<PointResidual> more_;
  std::vector<Part> parts_;
  std::vector<int> entries_;
  int max_residuals_ = 0;
  int max_blocks_ = 0;
  int max_linearization_ = 0;
  const BlockStructure* structure_ = nullptr;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_H_
