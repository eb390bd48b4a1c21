// A preconditioner that solves for the long waves on a coarse graph.
#ifndef CERES_ED_LINEAR_ALGEBRA_ITERATIVE_TWO_LEVEL_PRECONDITIONER_H_
#define CERES_ED_LINEAR_ALGEBRA_ITERATIVE_TWO_LEVEL_PRECONDITIONER_H_

#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/iterative/affine_prolongation.h>
#include <ceres_ed/linear_algebra/iterative/block_jacobi.h>
#include <ceres_ed/linear_algebra/iterative/preconditioner.h>

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// M^-1 = D^-1 + Z (Z^T A Z)^-1 Z^T, where D is BlockJacobi and Z is the prolongation of a coarse
// graph (additive Schwarz with a coarse space: Dryja and Widlund 1987; Toselli and Widlund 2005).
// D takes what differs from node to node, and the coarse graph takes what is smooth, which D alone
// would pass on by one ring in each iteration. So the number of iterations depends on how many
// nodes one coarse node stands for, rather than on the size of the graph. Blocks that are not those
// of nodes, such as the camera, are part of both. Rows of dual blocks are eliminated (A contains
// their J^T J), so that the coarse matrix has those of coarse nodes alone.
class TwoLevelPreconditioner final : public Preconditioner {
 public:
  // The first prolongation.num_fine() blocks of the matrix are nodes. `matrix` must outlive this
  // object.
  TwoLevelPreconditioner(const PrimalMatrix& matrix, AffineProlongation prolongation);

  bool Update(int num_threads) override;
  void Apply(const Eigen::VectorXd& x, int num_threads, Eigen::VectorXd* y) override;

  // The largest block of A: a node's columns and rows.
  static constexpr int kNode = kSplitBlockSize;
  using NodeBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kNode, kNode>;

 private:
  using Part = AffineProlongation::Part;

  struct DualRows;

  // Adds Z for all primal blocks that are not nodes: each is a coarse block of its own.
  void AddOtherBlocks();
  BlockStructure CoarseStructure() const;
  template <typename Visitor>
  void ForEachOfDual(int dual, const Visitor& visit) const;
  void MultiplyDual(int dual, DualRows* rows) const;
  template <typename Sum>
  void AddDuals(int coarse, DualRows* rows, const Sum& sum_of) const;
  void UpdateColumn(int coarse, std::vector<int>* places, DualRows* rows);
  bool IsNode(int block) const { return block < num_nodes_; }
  const Part* begin(int block) const { return Z_.parts.data() + Z_.begins[block]; }
  const Part* end(int block) const { return Z_.parts.data() + Z_.begins[block + 1]; }

  const PrimalMatrix& matrix_;
  const int num_nodes_;
  AffineProlongation Z_;
  // Z by columns: a fine block, and which of its parts.
  struct ColumnPart {
    int fine = 0;
    int part = 0;
  };
  std::vector<int> column_begins_;
  std::vector<ColumnPart> column_parts_;
  BlockJacobi jacobi_;
  std::unique_ptr<BlockStructure> coarse_structure_;
  std::vector<double> coarse_values_;
  std::unique_ptr<BlockCholesky> coarse_factor_;
  Eigen::VectorXd coarse_rows_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ITERATIVE_TWO_LEVEL_PRECONDITIONER_H_
