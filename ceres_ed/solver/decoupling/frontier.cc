#include "ceres_ed/solver/decoupling/frontier.h"

#include <algorithm>
#include <set>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// What is added to the diagonal of a block, relative to its mean, for parameters without curvature.
constexpr double kLeastRelativeDiagonal = 1e-9;

// A search ends after this number of visits for each node in the mean. Soft motions of many nodes
// would take more, for next to no change of the set.
constexpr int kMaxVisits = 30;

// Returns the sum of the decrements in a queue of negative decrements.
double SumOf(const std::set<std::pair<double, int>>& queue) {
  double sum = 0.0;
  for (const auto& [negative, place] : queue) sum -= negative;
  return sum;
}

}  // namespace

bool Frontier::Evaluate(const ProblemBuilder& builder,
                        const std::vector<char>& mask,
                        const DeformationState& before,
                        const DeformationState& after,
                        int num_threads) {
  ProblemConfig config;
  config.variable_nodes = mask;
  equations_.Build(builder, config);
  structure_ = std::make_unique<BlockStructure>(equations_.BlockSizes(), equations_.BlockPairs());
  CHECK(equations_.SetStructure(structure_.get()));
  double cost = 0.0;
  Eigen::VectorXd gradient;
  if (!equations_.EvaluateGradient(before, num_threads, &cost, &gradient) ||
      !equations_.Evaluate(after, num_threads, &cost, &values_, &gradient_) ||
      !gradient.allFinite() || !gradient_.allFinite() ||
      !structure_->Diagonal(values_).allFinite()) {
    equations_ = NormalEquations();
    return false;
  }
  gradient_ -= gradient;
  factors_.clear();
  for (int i = 0; i < equations_.num_variable_nodes(); ++i) {
    NodeMatrix block = Block(i);
    const double floor = std::max(kLeastRelativeDiagonal * block.diagonal().mean(), 1e-300);
    block.diagonal().array() += floor;
    factors_.emplace_back(block);
    // Rounding may take the definiteness of a block away, but not that of its diagonal.
    if (factors_.back().info() != Eigen::Success) {
      factors_.back().compute(NodeMatrix(block.diagonal().cwiseAbs().cwiseMax(floor).asDiagonal()));
    }
  }
  FindNeighbors();
  return true;
}

Frontier::NodeMatrix Frontier::Block(int place) const {
  const std::size_t offset = structure_->value_offset(structure_->column_begin(place));
  return Eigen::Map<const NodeMatrix>(values_.data() + offset).selfadjointView<Eigen::Lower>();
}

void Frontier::FindNeighbors() {
  const int count = equations_.num_variable_nodes();
  std::vector<std::vector<Neighbor>> lists(count);
  for (int j = 0; j < count; ++j) {
    for (int e = structure_->column_begin(j) + 1; e < structure_->column_begin(j + 1); ++e) {
      const int i = structure_->entry_row(e);
      lists[j].push_back({i, e, true});
      lists[i].push_back({j, e, false});
    }
  }
  first_neighbor_.assign(1, 0);
  neighbors_.clear();
  for (const std::vector<Neighbor>& list : lists) {
    neighbors_.insert(neighbors_.end(), list.begin(), list.end());
    first_neighbor_.push_back(static_cast<int>(neighbors_.size()));
  }
}

Frontier::NodeVector Frontier::Step(int place, const NodeVector& gradient) const {
  return -factors_[place].solve(gradient);
}

double Frontier::Decrement(int place) const {
  const NodeVector gradient =
      gradient_.segment<kNodeSize>(static_cast<Eigen::Index>(place) * kNodeSize);
  return DecrementOf(gradient, Step(place, gradient));
}

FrontierSearch Frontier::Search(double budget) const {
  const int count = static_cast<int>(nodes().size());
  FrontierSearch search;
  Eigen::VectorXd gradient = gradient_;
  std::vector<double> decrements(count, 0.0);
  // The place of each node in `released`, or -1.
  std::vector<int> order(count, -1);
  // The nodes that feel a force, the largest decrement first.
  std::set<std::pair<double, int>> queue;
  for (int i = 0; i < count; ++i) {
    decrements[i] = Decrement(i);
    search.decrement += decrements[i];
    if (decrements[i] > 0.0) queue.emplace(-decrements[i], i);
  }
  search.num_pushed = static_cast<int>(queue.size());
  double sum = search.decrement;
  int num_released = 0;
  int num_forced = search.num_pushed;
  for (int visit = 0; visit < kMaxVisits * count && num_released < num_forced; ++visit) {
    // The running sum has rounding errors, so it does not end the search alone.
    if (sum <= budget && (sum = SumOf(queue)) <= budget) break;
    const int i = queue.begin()->second;
    queue.erase(queue.begin());
    if (order[i] < 0) {
      order[i] = num_released++;
      search.released.push_back({i, decrements[i], 0.0});
    }
    search.released[order[i]].gain += decrements[i];
    sum -= decrements[i];
    const NodeVector step =
        Step(i, gradient.segment<kNodeSize>(static_cast<Eigen::Index>(i) * kNodeSize));
    gradient.segment<kNodeSize>(static_cast<Eigen::Index>(i) * kNodeSize).setZero();
    decrements[i] = 0.0;
    for (int n = first_neighbor_[i]; n < first_neighbor_[i + 1]; ++n) {
      const Neighbor& neighbor = neighbors_[n];
      const int k = neighbor.place;
      const Eigen::Map<const NodeMatrix> block(values_.data() +
                                               structure_->value_offset(neighbor.entry));
      auto g = gradient.segment<kNodeSize>(static_cast<Eigen::Index>(k) * kNodeSize);
      // A neighbour with a lower place stands in the row of the block, another one in its column.
      g += neighbor.stored ? NodeVector(block * step) : NodeVector(block.transpose() * step);
      const double before = decrements[k];
      queue.erase({-before, k});
      decrements[k] = DecrementOf(g, Step(k, g));
      sum += decrements[k] - before;
      if (decrements[k] > 0.0) queue.emplace(-decrements[k], k);
      // Of the nodes that were not released, those with a force are counted.
      if (order[k] < 0) num_forced += (decrements[k] > 0.0 ? 1 : 0) - (before > 0.0 ? 1 : 0);
    }
  }
  for (const auto& [negative, place] : queue) {
    if (order[place] < 0) search.left -= negative;
  }
  return search;
}

}  // namespace ceres_ed
