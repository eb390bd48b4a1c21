// The Gauss-Newton normal equations of a subproblem, assembled in blocks.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_NORMAL_EQUATIONS_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_NORMAL_EQUATIONS_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/normal_equations/point_groups.h>

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <ceres/loss_function.h>
#include <cost_functions/quadratic_cost.h>
#include <cost_functions/regularization_cost.h>

namespace ceres_ed {

// Residuals couple the affine parts of their nodes. Dual unknowns y in place of their products keep
// these apart (see BlockCholesky), with J the Jacobian of the residuals:
//   [H J^T; J -I] [x; y] = [b; 0]  <=>  (H + J^T J) x = b
// That pays where points are few, and for a residual on many nodes at once, such as a volume, which
// would join each of them to all others.
inline constexpr int kDualSize = 3;
enum class DualResiduals { kNever, kWhereTheyPay };

// Unknowns: one block of 12 a variable node, in the order of the nodes, then one of 6 for a
// variable camera (rotation in the tangent space of ceres::EigenQuaternionManifold, then
// translation). Builder and config must outlive this, and their residuals stay as they are.
//
// Residuals are taken by their form: points by the nodes that carry them, edges and rotations in
// closed form where they have no loss, all others by their Jacobians. They are dealt out to parts,
// strips of the graph that are the same at any number of threads: what one part alone touches it
// sums up in place, what it shares with others in a place of its own, and these are added up at the
// end.
class NormalEquations {
 public:
  NormalEquations() = default;
  NormalEquations(const ProblemBuilder& builder, const ProblemConfig& config) {
    Build(builder, config);
  }
  NormalEquations(const ProblemBuilder& builder,
                  const std::vector<SelectedResidual>& residuals,
                  const std::vector<int>& variable_nodes) {
    Build(builder, residuals, variable_nodes);
  }

  // Takes the problem of `config`; what was there is gone, its memory is kept.
  void Build(const ProblemBuilder& builder,
             const ProblemConfig& config,
             DualResiduals dual_residuals = DualResiduals::kNever);
  // Takes some residuals of the builder alone, with the blocks in the order of `variable_nodes`;
  // the camera is held.
  void Build(const ProblemBuilder& builder,
             const std::vector<SelectedResidual>& residuals,
             const std::vector<int>& variable_nodes);

  int num_variable_nodes() const { return static_cast<int>(variable_nodes_.size()); }
  const std::vector<int>& variable_nodes() const { return variable_nodes_; }
  bool camera_variable() const { return camera_variable_; }
  // Dual blocks, of points (one each, or none) and then of wide residuals: the last ones. Their
  // rows of the gradient are zero.
  int num_dual() const { return num_dual_; }
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
  // A residual block that has no form of its own, or that one of nodes without a loss of which the
  // square of the Jacobian is known.
  struct Item {
    SelectedResidual residual;
    std::shared_ptr<const ceres::CostFunction> cost;
    const QuadraticCost* quadratic = nullptr;
    int width = 0;
    int first_part = 0;
    int num_parts = 0;
    // Of parts a >= b: first_slot + a (a + 1) / 2 + b. All slots are in this order. With dual
    // blocks those of (a, a) come first, and then, dual block by dual block, those with each part.
    int first_slot = 0;
    int first_dual = 0;
    int num_dual = 0;

    // Doubles that the item's linearisation takes.
    int LinearizationSize() const;
  };
  // E_reg and E_rot. A block is -1 where its node is held.
  struct Edge {
    const RegularizationCost* cost = nullptr;
    double weight = 1.0;
    int nodes[2] = {-1, -1};
    int blocks[2] = {-1, -1};
    int first_slot = 0;
  };
  struct Rotation {
    double weight = 1.0;
    int node = -1;
    int block = -1;
    int slot = 0;
  };
  // Two blocks that a residual joins, and the entry of the structure; row -1 where one is held. A
  // diagonal slot comes with its rows of the gradient.
  struct Slot {
    int row = -1;
    int column = -1;
    bool affine = true;
    int entry = -1;
    // Where its values, and its part of the gradient, go: into those of the structure, or, where
    // other parts add to the entry too, num_values() + the place in `shared`.
    std::ptrdiff_t target = 0;
  };
  // What goes from `shared` into an entry.
  struct Share {
    int entry = -1;
    int row = -1;
    int column = -1;
    std::ptrdiff_t place = 0;
  };
  // One of the tasks that the residuals are dealt out to.
  struct Task {
    std::vector<int> groups;
    std::vector<int> edges;
    std::vector<int> rotations;
    std::vector<int> items;

    void Clear() {
      for (std::vector<int>* list : {&groups, &edges, &rotations, &items}) list->clear();
    }
  };
  // Where sums go; values, and gradient, too, may be null.
  struct Sums {
    double* values = nullptr;
    double* gradient = nullptr;
    double* shared = nullptr;
  };
  struct ItemScratch;
  struct PointScratch;

  // Building.
  void Clear();
  void AddResiduals(const ProblemBuilder& builder, const std::vector<SelectedResidual>& residuals);
  void AddItem(const SelectedResidual& residual, const DeformationGraph& graph);
  void AddClosedForm(const SelectedResidual& residual);
  void AddSlot(int a, int b, bool affine);
  void ChooseDualPoints();
  void ChooseDualItems();
  int DualBlock(int dual) const { return num_variable_nodes() + (camera_variable_ ? 1 : 0) + dual; }
  void AddGroupSlots(const PointGroup& group, const DeformationGraph& graph);
  void AddDualSlots(const PointGroup& group);
  void AddDualItemSlots(const Item& item);
  void AddSlots(const DeformationGraph& graph);
  void DealOut(const DeformationGraph& graph);
  void FindTargets(const BlockStructure& structure);
  template <typename Visitor>
  void ForEachSlot(const Task& task, const Visitor& visitor);
  int NumItemSlots(const Item& item) const {
    return item.num_dual > 0 ? item.num_parts * (1 + item.num_dual)
                             : item.num_parts * (item.num_parts + 1) / 2;
  }
  int NumGroupSlots(const PointGroup& group) const;
  int DiagonalSlot(int group, int node) const;
  bool VariesCamera(const PointGroup& group) const { return group.has_camera && camera_variable_; }

  // Evaluating. `sums.gradient` is null where the cost alone is wanted.
  double* Values(int slot, const Sums& sums) const;
  double* Gradient(int slot, const Sums& sums) const;
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
  bool LinearizeItem(const Item& item,
                     const DeformationState& state,
                     double* linearization,
                     ItemScratch* scratch,
                     double* cost) const;
  void AccumulateItem(const Item& item, const double* linearization, const Sums& sums) const;
  void AccumulateGradient(
      const Item& item, int part, int slot, const double* linearization, const Sums& sums) const;
  void SpreadDualItem(const Item& item, const double* linearization, const Sums& sums) const;
  bool LinearizeQuadratic(const Item& item,
                          const DeformationState& state,
                          double* gradient,
                          ItemScratch* scratch,
                          double* cost) const;
  void AccumulateQuadratic(const Item& item, const double* gradient, const Sums& sums) const;
  bool AddItems(const Task& task,
                const DeformationState& state,
                const Sums& sums,
                double* cost) const;
  bool AddEdge(const Edge& edge,
               const DeformationState& state,
               const Sums& sums,
               double* cost) const;
  bool AddRotation(const Rotation& rotation,
                   const DeformationState& state,
                   const Sums& sums,
                   double* cost) const;
  void WarpGroup(const PointGroup& group,
                 const DeformationState& state,
                 PointScratch* scratch) const;
  bool AddRun(const PointRun& run,
              bool has_camera,
              bool linearize,
              PointScratch* scratch,
              double* cost) const;
  bool AddGroup(int index,
                const DeformationState& state,
                const Sums& sums,
                PointScratch* scratch,
                double* cost) const;
  void SpreadGradients(int index, const PointScratch& scratch, const Sums& sums) const;
  void SpreadProducts(int index, const PointScratch& scratch, const Sums& sums) const;
  void SpreadDuals(int index, const double* moments, const Sums& sums) const;
  bool AddGroups(const Task& task,
                 const DeformationState& state,
                 const Sums& sums,
                 double* cost) const;
  void SetDualDiagonals(double* values) const;
  void AddShares(const Sums& sums) const;
  bool AddTask(const Task& task,
               const DeformationState& state,
               const Sums& sums,
               double* cost) const;
  bool EvaluateTasks(const DeformationState& state,
                     int num_threads,
                     double* cost,
                     std::vector<double>* values,
                     Eigen::VectorXd* gradient) const;

  std::vector<int> variable_nodes_;
  bool camera_variable_ = false;
  // Of points alone, and all.
  int num_dual_points_ = 0;
  int num_dual_ = 0;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;
  PointGroups points_;
  // First slot of each group, and, in the order of their nodes, blocks and positions.
  std::vector<int> group_slots_;
  std::vector<int> group_blocks_;
  std::vector<Eigen::Vector3d> group_positions_;
  std::vector<Edge> edges_;
  std::vector<Rotation> rotations_;
  std::vector<Item> items_;
  std::vector<Part> parts_;
  std::vector<Slot> slots_;
  std::vector<Task> tasks_;
  int max_residuals_ = 0;
  int max_blocks_ = 0;
  int max_linearization_ = 0;
  const BlockStructure* structure_ = nullptr;
  std::vector<Share> shares_;
  std::size_t shared_size_ = 0;
  // One object serves one thread at a time.
  mutable std::vector<double> shared_;
  // While building.
  std::vector<SelectedResidual> selected_;
  std::vector<int> block_of_node_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_NORMAL_EQUATIONS_H_
