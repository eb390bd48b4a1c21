// Which nodes carry which point, and how much (Eq. 2).
#ifndef CERES_ED_GRAPH_SKINNING_H_
#define CERES_ED_GRAPH_SKINNING_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {

// The nodes of one point: `size` indices and weights. Weights are positive and sum to 1.
struct Binding {
  const int* nodes = nullptr;
  const double* weights = nullptr;
  int size = 0;
};

// The bindings of a set of points, in flat arrays of `stride` places a point.
class Skinning {
 public:
  // At most `stride` nodes a point, in [1, kMaxBoundNodes].
  explicit Skinning(int stride = 4) : stride_(stride) {
    CHECK(stride >= 1 && stride <= kMaxBoundNodes) << "stride " << stride;
  }

  int stride() const { return stride_; }
  std::size_t size() const { return sizes_.size(); }
  Binding operator[](std::size_t point) const {
    return {&nodes_[point * stride_], &weights_[point * stride_], sizes_[point]};
  }

  void Reserve(std::size_t points) {
    nodes_.reserve(points * stride_);
    weights_.reserve(points * stride_);
    sizes_.reserve(points);
  }

  // Appends a point bound to `size` >= 1 nodes.
  void Add(const int* nodes, const double* weights, int size) {
    nodes_.resize(nodes_.size() + stride_);
    weights_.resize(weights_.size() + stride_);
    sizes_.push_back(0);
    Set(sizes_.size() - 1, nodes, weights, size);
  }

  // Binds a point that is there anew.
  void Set(std::size_t point, const int* nodes, const double* weights, int size) {
    CHECK(size >= 1 && size <= stride_) << "binding of " << size << " nodes";
    for (int i = 0; i < stride_; ++i) {
      nodes_[point * stride_ + i] = i < size ? nodes[i] : -1;
      weights_[point * stride_ + i] = i < size ? weights[i] : 0.0;
    }
    sizes_[point] = static_cast<std::uint8_t>(size);
  }

 private:
  int stride_;
  std::vector<int> nodes_;
  std::vector<double> weights_;
  std::vector<std::uint8_t> sizes_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_SKINNING_H_
