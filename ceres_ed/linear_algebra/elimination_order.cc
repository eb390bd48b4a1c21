#include "ceres_ed/linear_algebra/elimination_order.h"

#include <algorithm>

#include <glog/logging.h>

#ifdef CERES_ED_HAVE_CHOLMOD
#include <cholmod.h>
#else
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#endif

namespace ceres_ed {
namespace {

// The columns of a symmetric pattern with its diagonal; each column is sorted by row.
struct Pattern {
  std::vector<int> begins = {0};
  std::vector<int> rows;

  int size() const { return static_cast<int>(begins.size()) - 1; }
};

// Returns the graph on the vertices that have a number `index` >= 0, after all other vertices with
// `first` have been eliminated; the elimination of a vertex joins its neighbours to each other. The
// result contains the lower triangle only.
Pattern Condensed(const RowGraph& graph,
                  const std::vector<char>& first,
                  const std::vector<int>& index) {
  Pattern pattern;
  std::vector<int> seen(graph.num_vertices(), -1);
  const auto add = [&](int vertex, int neighbor) {
    if (index[neighbor] < index[vertex] || seen[neighbor] == vertex) return;
    seen[neighbor] = vertex;
    pattern.rows.push_back(index[neighbor]);
  };
  for (int v = 0; v < graph.num_vertices(); ++v) {
    if (index[v] < 0) continue;
    add(v, v);
    for (int k = graph.begins[v]; k < graph.begins[v + 1]; ++k) {
      const int u = graph.neighbors[k];
      add(v, u);
      if (first[u] == 0) continue;
      for (int l = graph.begins[u]; l < graph.begins[u + 1]; ++l) add(v, graph.neighbors[l]);
    }
    std::sort(pattern.rows.begin() + pattern.begins.back(), pattern.rows.end());
    pattern.begins.push_back(static_cast<int>(pattern.rows.size()));
  }
  return pattern;
}

#ifdef CERES_ED_HAVE_CHOLMOD

std::vector<int> Order(Pattern* pattern, OrderingMethod method) {
  const int n = pattern->size();
  cholmod_sparse view{};
  view.nrow = view.ncol = n;
  view.nzmax = pattern->rows.size();
  view.p = pattern->begins.data();
  view.i = pattern->rows.data();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  std::vector<int> order(n);
  std::vector<int> parents(n);
  std::vector<int> members(n);
  const bool done =
      method == OrderingMethod::kNestedDissection
          ? cholmod_nested_dissection(
                &view, nullptr, 0, order.data(), parents.data(), members.data(), &common) > 0
          : cholmod_amd(&view, nullptr, 0, order.data(), &common) != 0;
  CHECK(done) << "CHOLMOD status " << common.status;
  cholmod_finish(&common);
  return order;
}

#else

std::vector<int> Order(Pattern* pattern, OrderingMethod /*method*/) {
  const std::vector<double> ones(pattern->rows.size(), 1.0);
  using Lower = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
  const Lower lower = Eigen::Map<const Lower>(pattern->size(),
                                              pattern->size(),
                                              static_cast<Eigen::Index>(ones.size()),
                                              pattern->begins.data(),
                                              pattern->rows.data(),
                                              ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), order);
  return {order.indices().data(), order.indices().data() + order.size()};
}

#endif

// Returns, for each vertex, the number of the connected part of the graph that it belongs to.
std::vector<int> ConnectedParts(const RowGraph& graph) {
  std::vector<int> part(graph.num_vertices(), -1);
  std::vector<int> open;
  int num_parts = 0;
  for (int start = 0; start < graph.num_vertices(); ++start) {
    if (part[start] >= 0) continue;
    part[start] = num_parts;
    open.push_back(start);
    while (!open.empty()) {
      const int v = open.back();
      open.pop_back();
      for (int k = graph.begins[v]; k < graph.begins[v + 1]; ++k) {
        const int u = graph.neighbors[k];
        if (part[u] >= 0) continue;
        part[u] = num_parts;
        open.push_back(u);
      }
    }
    ++num_parts;
  }
  return part;
}

// Three points fix a rigid motion unless they lie on a line, which a fourth point makes unlikely.
constexpr int kAnchors = 4;

// Moves the last kAnchors vertices of each part that are neither dual nor `first` to the end of the
// order.
void PutAnchorsLast(const RowGraph& graph,
                    const std::vector<char>& first,
                    std::vector<int>* order) {
  const std::vector<int> part = ConnectedParts(graph);
  std::vector<int> num_anchors(graph.num_vertices(), 0);
  std::vector<char> is_anchor(graph.num_vertices(), 0);
  for (auto v = order->rbegin(); v != order->rend(); ++v) {
    if (graph.is_dual[*v] != 0 || first[*v] != 0) continue;
    if (num_anchors[part[*v]]++ < kAnchors) is_anchor[*v] = 1;
  }
  std::stable_partition(order->begin(), order->end(), [&](int v) { return is_anchor[v] == 0; });
}

}  // namespace

bool HasNestedDissection() {
#ifdef CERES_ED_HAVE_CHOLMOD
  return true;
#else
  return false;
#endif
}

std::vector<int> FillReducingOrder(const RowGraph& graph,
                                   const std::vector<char>& first,
                                   int num_trailing,
                                   OrderingMethod method) {
  const int num_free = graph.num_vertices() - num_trailing;
  std::vector<int> order;
  std::vector<int> index(graph.num_vertices(), -1);
  std::vector<int> left;
  for (int v = 0; v < num_free; ++v) {
    if (first[v] != 0) {
      order.push_back(v);
    } else {
      index[v] = static_cast<int>(left.size());
      left.push_back(v);
    }
  }
  if (!left.empty()) {
    Pattern condensed = Condensed(graph, first, index);
    for (const int k : Order(&condensed, method)) order.push_back(left[k]);
  }
  if (std::find(graph.is_dual.begin(), graph.is_dual.end(), 1) != graph.is_dual.end()) {
    CHECK_EQ(num_trailing, 0) << "dual vertices and trailing ones exclude each other";
    PutAnchorsLast(graph, first, &order);
  }
  for (int v = num_free; v < graph.num_vertices(); ++v) order.push_back(v);
  return order;
}

}  // namespace ceres_ed
