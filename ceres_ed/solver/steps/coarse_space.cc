#include "ceres_ed/solver/steps/coarse_space.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ceres_ed {
namespace {

// The number of coarse nodes that a node follows.
constexpr int kMaxParts = 3;

// Visits the nodes that are at most `rings` neighbours away from a node, ring by ring.
class RingWalk {
 public:
  RingWalk(const PrimalMatrix& matrix, int num_nodes)
      : matrix_(matrix), num_nodes_(num_nodes), seen_(num_nodes, -1) {}

  // Returns the nodes, `start` first. The result is valid until the next call.
  const std::vector<int>& Around(int start, int rings) {
    found_.assign(1, start);
    seen_[start] = ++walk_;
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t end = found_.size();
      for (std::size_t f = begin; f < end; ++f) {
        const int node = found_[f];
        for (const auto* n = matrix_.begin(node); n != matrix_.end(node); ++n) {
          if (n->block >= num_nodes_ || seen_[n->block] == walk_) continue;
          seen_[n->block] = walk_;
          found_.push_back(n->block);
        }
      }
      begin = end;
    }
    return found_;
  }

 private:
  const PrimalMatrix& matrix_;
  const int num_nodes_;
  std::vector<int> seen_;
  int walk_ = -1;
  std::vector<int> found_;
};

// The nearest coarse nodes of a node, by distance: one more than it follows, since the weights
// vanish at the distance of the next one.
struct Nearest {
  int size = 0;
  std::array<std::pair<double, int>, kMaxParts + 1> coarse;

  void Add(double distance, int node) {
    const std::pair<double, int> entry(distance, node);
    if (size < static_cast<int>(coarse.size())) {
      coarse[size++] = entry;
    } else if (entry < coarse[size - 1]) {
      coarse[size - 1] = entry;
    } else {
      return;
    }
    for (int i = size - 1; i > 0 && coarse[i] < coarse[i - 1]; --i) {
      std::swap(coarse[i], coarse[i - 1]);
    }
  }
};

std::vector<int> ChooseCoarseNodes(int num_nodes, RingWalk* walk) {
  std::vector<int> chosen;
  std::vector<char> covered(num_nodes, 0);
  for (int node = 0; node < num_nodes; ++node) {
    if (covered[node] != 0) continue;
    chosen.push_back(node);
    for (const int other : walk->Around(node, kCoarseRings)) covered[other] = 1;
  }
  return chosen;
}

}  // namespace

AffineProlongation MakeCoarseSpace(const PrimalMatrix& matrix,
                                   const std::vector<Eigen::Vector3d>& positions) {
  const auto num_nodes = static_cast<int>(positions.size());
  RingWalk walk(matrix, num_nodes);
  const std::vector<int> coarse = ChooseCoarseNodes(num_nodes, &walk);
  std::vector<Nearest> nearest(num_nodes);
  for (int c = 0; c < static_cast<int>(coarse.size()); ++c) {
    for (const int node : walk.Around(coarse[c], 2 * kCoarseRings)) {
      nearest[node].Add((positions[node] - positions[coarse[c]]).norm(), c);
    }
  }
  AffineProlongation prolongation;
  prolongation.num_coarse = static_cast<int>(coarse.size());
  for (int node = 0; node < num_nodes; ++node) {
    const Nearest& found = nearest[node];
    const int size = std::min(found.size, kMaxParts);
    // Where there is no further coarse node, a little more than the distance of the last one.
    const double reach = found.size > kMaxParts ? found.coarse[kMaxParts].first
                                                : 1.25 * found.coarse[size - 1].first;
    double sum = 0.0;
    const auto first = static_cast<std::ptrdiff_t>(prolongation.parts.size());
    for (int i = 0; i < size; ++i) {
      AffineProlongation::Part part;
      part.coarse = found.coarse[i].second;
      const double nearness = reach > 0.0 ? 1.0 - found.coarse[i].first / reach : 1.0;
      part.weight = nearness * nearness;
      if (!(part.weight > 0.0) && sum > 0.0) break;
      part.weight = std::max(part.weight, 1e-3);
      part.lever = positions[node] - positions[coarse[part.coarse]];
      sum += part.weight;
      prolongation.parts.push_back(part);
    }
    for (auto part = prolongation.parts.begin() + first; part != prolongation.parts.end(); ++part) {
      part->weight /= sum;
    }
    prolongation.begins.push_back(static_cast<int>(prolongation.parts.size()));
  }
  return prolongation;
}

}  // namespace ceres_ed
