// The Gauss-Newton normal equations of a problem or of a part of it, assembled in blocks.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_NORMAL_EQUATIONS_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_NORMAL_EQUATIONS_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/problem/point_batches.h>
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

// The size of a dual block, and whether residuals get dual unknowns.
//
// A residual couples the affine parts of all its nodes. Dual unknowns y keep these parts separate
// (see BlockCholesky). With J the Jacobian of the residuals,
//   [H J^T; J -I] [x; y] = [b; 0]  <=>  (H + J^T J) x = b
// This saves time if there are few points, and for a residual on many nodes at once, such as a
// volume, which would otherwise couple each of its nodes to all others.
inline constexpr int kDualSize = 3;
enum class DualResiduals { kNever, kWhereTheyPay };

// The normal equations of a problem.
//
// The unknowns are one block of 12 per variable node, in the order of the nodes, then one block of
// 6 if the camera is variable (the rotation in the tangent space of ceres::EigenQuaternionManifold,
// then the translation). The builder and the config must outlive this object, and their residuals
// must not change.
//
// Residuals are treated by their form: points are grouped by the nodes to which they are bound;
// edges (E_reg, Eq. 6) and rotations (E_rot, Eq. 4 and 5) have closed forms if they have no loss;
// all others are treated through their Jacobians. The residuals are divided among tasks, which are
// strips of the graph that do not depend on the number of threads. A task adds to an entry in place
// if no other task uses the entry. For shared entries each task has separate memory, which is added
// up at the end.
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

  // Takes the problem of `config` and replaces the previous problem, whose memory is reused.
  void Build(const ProblemBuilder& builder,
             const ProblemConfig& config,
             DualResiduals dual_residuals = DualResiduals::kNever);
  // Takes only some residuals of the builder, with the blocks in the order of `variable_nodes`; the
  // camera is constant.
  void Build(const ProblemBuilder& builder,
             const std::vector<SelectedResidual>& residuals,
             const std::vector<int>& variable_nodes);

  int num_variable_nodes() const { return static_cast<int>(variable_nodes_.size()); }
  const std::vector<int>& variable_nodes() const { return variable_nodes_; }
  bool camera_variable() const { return camera_variable_; }
  // Returns the number of dual blocks, which come last: first those of points (one per point, or
  // none), then those of wide residuals. Their rows of the gradient are zero.
  int num_dual() const { return num_dual_; }
  // Returns the number of rows of each block.
  std::vector<int> BlockSizes() const;
  // Returns the pairs of blocks that share a residual, sorted by column and then by row, without
  // repetition.
  std::vector<BlockPair> BlockPairs() const;

  // Determines where the products of each residual are added. `structure` must outlive this object.
  // Returns false, and sets no structure, if `structure` lacks one of BlockPairs() or its affine
  // part.
  bool SetStructure(const BlockStructure* structure);

  // Computes cost = sum of rho(|r|^2) / 2, values = J^T J in the layout of the structure (diagonal
  // blocks in full) and gradient = J^T r. r and J are corrected for the loss as in Ceres. Returns
  // false if a cost function fails or returns a value that is not finite.
  bool Evaluate(const DeformationState& state,
                int num_threads,
                double* cost,
                std::vector<double>* values,
                Eigen::VectorXd* gradient) const;

  // Computes the cost and its gradient.
  bool EvaluateGradient(const DeformationState& state,
                        int num_threads,
                        double* cost,
                        Eigen::VectorXd* gradient) const;

  // Computes the cost only.
  bool EvaluateCost(const DeformationState& state, int num_threads, double* cost) const;

  // Computes state + delta, on the manifold of the camera. `delta` has the layout of the unknowns.
  void Plus(const Eigen::VectorXd& delta, DeformationState* state) const;

  // Returns the Euclidean norm of all variable parameters, which Ceres uses for its parameter
  // tolerance.
  double ParameterNorm(const DeformationState& state) const;

 private:
  // A part of a residual's Jacobian: `width` columns from `column` on belong to the rows from
  // `offset` on of `block`.
  struct Part {
    int block = -1;
    int offset = 0;
    int width = 0;
    int column = 0;
    // Whether the part depends on more than the translation of a node.
    bool affine = true;
  };
  // A residual block without a closed form. If it is a quadratic cost on nodes without a loss,
  // `quadratic` gives its Hessian directly.
  struct Item {
    SelectedResidual residual;
    std::shared_ptr<const ceres::CostFunction> cost;
    const QuadraticCost* quadratic = nullptr;
    int width = 0;
    int first_part = 0;
    int num_parts = 0;
    // The slot of parts a >= b is first_slot + a (a + 1) / 2 + b. With dual blocks the slots of (a,
    // a) come first, followed by the slots of each dual block with each part.
    int first_slot = 0;
    int first_dual = 0;
    int num_dual = 0;

    // Returns the number of doubles that the linearisation of the item needs.
    int LinearizationSize() const;
  };
  // A residual of E_reg (Edge) or E_rot (Rotation). A block is -1 if its node is constant.
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
  // Two blocks that a residual couples, and their entry in the structure; the row is -1 if one of
  // them is constant. A diagonal slot also stands for its rows of the gradient.
  struct Slot {
    int row = -1;
    int column = -1;
    bool affine = true;
    int entry = -1;
    // Where its values, and its part of the gradient, are added: an offset into the values of the
    // structure, or, if other tasks use the same entry, num_values() plus the offset in `shared`.
    std::ptrdiff_t target = 0;
  };
  // A part of `shared` that is added to an entry.
  struct Share {
    int entry = -1;
    int row = -1;
    int column = -1;
    std::ptrdiff_t place = 0;
  };
  // One of the tasks among which the residuals are divided.
  struct Task {
    std::vector<int> groups;
    std::vector<int> edges;
    std::vector<int> rotations;
    std::vector<int> items;

    void Clear() {
      for (std::vector<int>* list : {&groups, &edges, &rotations, &items}) list->clear();
    }
  };
  // Where the sums are stored. `values` may be null, and so may `gradient`.
  struct Sums {
    double* values = nullptr;
    double* gradient = nullptr;
    double* shared = nullptr;
  };
  struct ItemScratch;
  struct PointScratch;

  // Functions that build the equations.
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
  std::size_t NumSlots() const;
  int DiagonalSlot(int group, int node) const;
  bool VariesCamera(const PointGroup& group) const { return group.has_camera && camera_variable_; }

  // Functions that evaluate the equations. `sums.gradient` is null if only the cost is computed.
  double* Values(int slot, const Sums& sums) const;
  double* Gradient(int slot, const Sums& sums) const;
  // Returns the loss of a term, or null if it has none.
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
  bool EvaluateRun(
      const PointRun& run, int begin, int count, bool linearize, PointScratch* scratch) const;
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
  // The number of dual blocks of points, and of all dual blocks.
  int num_dual_points_ = 0;
  int num_dual_ = 0;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;
  PointGroups points_;
  // The first slot of each group; then, in the order of the groups' nodes, their blocks and
  // positions.
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
  // This buffer is the reason why one object serves one thread at a time.
  mutable std::vector<double> shared_;
  // The values of the batch functions at the state that is being evaluated.
  mutable PointBatches batches_;
  // Used only while building.
  std::vector<SelectedResidual> selected_;
  std::vector<int> block_of_node_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_NORMAL_EQUATIONS_H_
