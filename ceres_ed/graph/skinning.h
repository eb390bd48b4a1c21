// The nodes to which points are bound, and their weights (Eq. 2).
#ifndef CERES_ED_GRAPH_SKINNING_H_
#define CERES_ED_GRAPH_SKINNING_H_

#include <ceres_ed/util/chunked_rows.h>

#include <cstddef>

#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {

// The binding of one point: the indices and weights of `size` nodes. Weights are positive and sum
// to 1.
struct Binding {
  const int* nodes = nullptr;
  const double* weights = nullptr;
  int size = 0;
};

// The bindings of a set of points, with room for `stride` nodes for each point. Adding a point does
// not move the others.
class Skinning {
 public:
  // `stride` is the largest number of nodes for each point, in [1, kMaxBoundNodes].
  explicit Skinning(int stride = 4) : nodes_(stride), weights_(stride), sizes_(1) {
    CHECK(stride >= 1 && stride <= kMaxBoundNodes) << "stride " << stride;
  }

  int stride() const { return nodes_.width(); }
  std::size_t size() const { return sizes_.size(); }
  // Returns the binding of a point. It stays valid until the Skinning is destroyed.
  Binding operator[](std::size_t point) const {
    return {nodes_[point], weights_[point], *sizes_[point]};
  }

  // Appends a point that is bound to `size` nodes, in [1, stride()].
  void Add(const int* nodes, const double* weights, int size) {
    const std::size_t point = sizes_.size();
    nodes_.Resize(point + 1);
    weights_.Resize(point + 1);
    sizes_.Resize(point + 1);
    Set(point, nodes, weights, size);
  }

  // Replaces the binding of an existing point.
  void Set(std::size_t point, const int* nodes, const double* weights, int size) {
    CHECK(size >= 1 && size <= stride()) << "binding of " << size << " nodes";
    for (int i = 0; i < stride(); ++i) {
      nodes_[point][i] = i < size ? nodes[i] : -1;
      weights_[point][i] = i < size ? weights[i] : 0.0;
    }
    *sizes_[point] = static_cast<unsigned char>(size);
  }

 private:
  ChunkedRows<int> nodes_;
  ChunkedRows<double> weights_;
  ChunkedRows<unsigned char> sizes_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_SKINNING_H_
