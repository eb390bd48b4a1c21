// What it costs to hold nodes: the energy that they would lose if they were released.
#ifndef CERES_ED_SOLVER_DECOUPLING_FRONTIER_H_
#define CERES_ED_SOLVER_DECOUPLING_FRONTIER_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <algorithm>
#include <memory>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// A node of a Frontier, by its place in Frontier::nodes(): its decrement when it was released, and
// the energy that its steps have won in all. The gains of all nodes add up to what the search has
// won.
struct ReleasedNode {
  int place = -1;
  double decrement = 0.0;
  double gain = 0.0;
};

// The outcome of Frontier::Search().
struct FrontierSearch {
  // The nodes that have to be moved, in the order in which they were found.
  std::vector<ReleasedNode> released;
  // The sum of the decrements of all nodes before the search, and the number of nodes that have
  // one.
  double decrement = 0.0;
  int num_pushed = 0;
  // The sum of the decrements of the nodes that were not released, at the end.
  double left = 0.0;

  // Returns the mean of the decrements before the search, of the nodes that have one.
  double MeanOfPushed() const { return num_pushed > 0 ? decrement / num_pushed : 0.0; }
};

// What a motion of other nodes does to some nodes, by a quadratic model. Let g_j be the change of
// the gradient of node j that the motion causes, and H the Gauss-Newton matrix of the nodes. Then
//   d_j = g_j^T H_jj^-1 g_j / 2
// is the decrement of the node: the energy that it loses if it alone follows the motion. Let D be
// the matrix of the diagonal blocks of H, and a and b the smallest and the largest eigenvalue of
// D^-1/2 H D^-1/2. What all nodes lose if they all follow, g^T H^-1 g / 2, is between 1 / b and
// 1 / a times the sum of their decrements.
class Frontier {
 public:
  using NodeVector = Eigen::Matrix<double, kNodeSize, 1>;
  using NodeMatrix = Eigen::Matrix<double, kNodeSize, kNodeSize>;

  // Computes the model at `after` over the nodes whose entry in `mask` is not zero. Nodes that no
  // residual touches are left out. Returns false if a residual can't be evaluated; there are then
  // no nodes.
  bool Evaluate(const ProblemBuilder& builder,
                const std::vector<char>& mask,
                const DeformationState& before,
                const DeformationState& after,
                int num_threads);

  // Returns the nodes in ascending order. The other functions name a node by its place in this
  // list.
  const std::vector<int>& nodes() const { return equations_.variable_nodes(); }

  // Returns d_j.
  double Decrement(int place) const;

  // Chooses which nodes have to follow, so that what is left, the decrements of all nodes, adds up
  // to at most `budget`. Holding the others then loses at most budget / a. It is the
  // Gauss-Southwell method: the node with the largest decrement takes its step -H_jj^-1 g_j, which
  // adds to the gradients of its neighbours, until the rest is small enough, so that it goes as far
  // from the motion as the motion matters. It also ends if every node with a force is released, or
  // after a number of visits in proportion to the nodes. Changes no state. Of equal decrements the
  // one of the lower node comes first.
  FrontierSearch Search(double budget) const;

 private:
  struct Neighbor {
    int place = -1;
    // Entry of the structure, and whether the stored block is H_kj (row k), with k as the
    // neighbour.
    int entry = -1;
    bool stored = true;
  };

  NodeMatrix Block(int place) const;
  NodeVector Step(int place, const NodeVector& gradient) const;
  static double DecrementOf(const NodeVector& gradient, const NodeVector& step) {
    return std::max(0.0, -0.5 * gradient.dot(step));
  }
  void FindNeighbors();

  NormalEquations equations_;
  std::unique_ptr<BlockStructure> structure_;
  std::vector<double> values_;
  Eigen::VectorXd gradient_;
  // The factors of the diagonal blocks, one after the other.
  std::vector<Eigen::LLT<NodeMatrix>> factors_;
  // The neighbours of each node: those from first_neighbor_[place] on.
  std::vector<int> first_neighbor_;
  std::vector<Neighbor> neighbors_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DECOUPLING_FRONTIER_H_
