#include "ceres_ed/linear_algebra/front_tree.h"

#include <algorithm>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The cost of a front beyond its arithmetic, in multiplications: setting up the front, and adding
// each value of its update to the parent.
constexpr double kFrontOverhead = 2e4;
constexpr double kUpdateOverhead = 4.0;

std::vector<int> PositionsOf(const std::vector<int>& order) {
  std::vector<int> positions(order.size());
  for (int k = 0; k < static_cast<int>(order.size()); ++k) positions[order[k]] = k;
  return positions;
}

// Builds the fronts bottom-up. Each vertex starts as a front, and is merged with fronts below it
// where that saves time.
class FrontBuilder {
 public:
  FrontBuilder(const RowGraph& graph, const std::vector<int>& order, int num_trailing)
      : graph_(graph), order_(order), position_(PositionsOf(order)), num_trailing_(num_trailing) {}

  std::vector<Front> Build();

 private:
  void AddVertex(int vertex);
  void AddTrailing();
  void AddNeighborsBelow(int vertex, int position, std::vector<int>* below);
  void AddChildrenBelow(const std::vector<int>& children, int position, std::vector<int>* below);
  void Attach(Front front, const std::vector<int>& children);
  int Height(const std::vector<int>& vertices) const;
  std::vector<Front> Postordered();

  const RowGraph& graph_;
  const std::vector<int>& order_;
  const std::vector<int> position_;
  const int num_trailing_;
  std::vector<Front> fronts_;
  std::vector<std::vector<int>> children_;
  // For each position in the order: the fronts whose first row below is the vertex at that
  // position.
  std::vector<std::vector<int>> waiting_;
  std::vector<int> seen_;
};

int FrontBuilder::Height(const std::vector<int>& vertices) const {
  int height = 0;
  for (const int v : vertices) height += graph_.sizes[v];
  return height;
}

void FrontBuilder::AddNeighborsBelow(int vertex, int position, std::vector<int>* below) {
  for (int k = graph_.begins[vertex]; k < graph_.begins[vertex + 1]; ++k) {
    const int u = graph_.neighbors[k];
    if (position_[u] <= position || seen_[u] == position) continue;
    seen_[u] = position;
    below->push_back(u);
  }
}

void FrontBuilder::AddChildrenBelow(const std::vector<int>& children,
                                    int position,
                                    std::vector<int>* below) {
  for (const int child : children) {
    for (const int u : fronts_[child].below) {
      if (position_[u] <= position || seen_[u] == position) continue;
      seen_[u] = position;
      below->push_back(u);
    }
  }
}

void FrontBuilder::AddVertex(int vertex) {
  const int position = position_[vertex];
  const std::vector<int> children = std::move(waiting_[position]);
  Front front;
  front.columns = {vertex};
  AddNeighborsBelow(vertex, position, &front.below);
  AddChildrenBelow(children, position, &front.below);
  std::sort(front.below.begin(), front.below.end(), [&](int a, int b) {
    return position_[a] < position_[b];
  });
  front.width = graph_.sizes[vertex];
  front.height = front.width + Height(front.below);
  Attach(std::move(front), children);
}

// Adds one front for all trailing vertices, whether they are neighbours or not, so that the factor
// ends with a dense triangle.
void FrontBuilder::AddTrailing() {
  const int begin = graph_.num_vertices() - num_trailing_;
  Front front;
  front.columns.assign(order_.begin() + begin, order_.end());
  front.width = front.height = Height(front.columns);
  std::vector<int> children;
  for (int k = begin; k < graph_.num_vertices(); ++k) {
    children.insert(children.end(), waiting_[k].begin(), waiting_[k].end());
  }
  fronts_.push_back(std::move(front));
  children_.push_back(std::move(children));
}

double Cost(int width, int height) {
  const double left = height - width;
  return kFrontOverhead + FrontOperations(width, height) + kUpdateOverhead * left * left;
}

// Adds a front above `children`. A child is merged into it if one front costs less than the two.
void FrontBuilder::Attach(Front front, const std::vector<int>& children) {
  std::vector<int> columns;
  std::vector<int> kept;
  for (const int child : children) {
    Front& below = fronts_[child];
    const double apart = Cost(below.width, below.height) + Cost(front.width, front.height);
    if (Cost(below.width + front.width, below.width + front.height) > apart) {
      kept.push_back(child);
      continue;
    }
    front.width += below.width;
    front.height += below.width;
    columns.insert(columns.end(), below.columns.begin(), below.columns.end());
    kept.insert(kept.end(), children_[child].begin(), children_[child].end());
    below = Front();
    children_[child].clear();
  }
  columns.insert(columns.end(), front.columns.begin(), front.columns.end());
  front.columns = std::move(columns);
  if (!front.below.empty()) {
    waiting_[position_[front.below.front()]].push_back(static_cast<int>(fronts_.size()));
  }
  fronts_.push_back(std::move(front));
  children_.push_back(std::move(kept));
}

// Returns the fronts that were not merged into others, in postorder, so that each subtree is
// contiguous.
std::vector<Front> FrontBuilder::Postordered() {
  std::vector<char> is_child(fronts_.size(), 0);
  for (const std::vector<int>& children : children_) {
    for (const int child : children) is_child[child] = 1;
  }
  std::vector<Front> ordered;
  std::vector<int> new_index(fronts_.size(), -1);
  std::vector<std::pair<int, std::size_t>> stack;
  for (std::size_t root = 0; root < fronts_.size(); ++root) {
    if (is_child[root] != 0 || fronts_[root].columns.empty()) continue;
    stack.emplace_back(static_cast<int>(root), 0);
    while (!stack.empty()) {
      auto& [f, next] = stack.back();
      if (next < children_[f].size()) {
        stack.emplace_back(children_[f][next++], 0);
        continue;
      }
      new_index[f] = static_cast<int>(ordered.size());
      for (const int child : children_[f]) ordered[new_index[child]].parent = new_index[f];
      ordered.push_back(std::move(fronts_[f]));
      stack.pop_back();
    }
  }
  return ordered;
}

std::vector<Front> FrontBuilder::Build() {
  const int n = graph_.num_vertices();
  waiting_.resize(n);
  seen_.assign(n, -1);
  for (int k = 0; k < n - num_trailing_; ++k) AddVertex(order_[k]);
  if (num_trailing_ > 0) AddTrailing();
  std::vector<Front> fronts = Postordered();
  for (Front& front : fronts) {
    const auto end_of_dual = std::stable_partition(
        front.columns.begin(), front.columns.end(), [&](int v) { return graph_.is_dual[v] != 0; });
    front.dual_width = Height({front.columns.begin(), end_of_dual});
  }
  // Sorts the rows below in the final order of elimination.
  std::vector<int> place(n);
  int next = 0;
  for (const Front& front : fronts) {
    for (const int v : front.columns) place[v] = next++;
  }
  for (Front& front : fronts) {
    std::sort(
        front.below.begin(), front.below.end(), [&](int a, int b) { return place[a] < place[b]; });
  }
  return fronts;
}

}  // namespace

double FrontOperations(int width, int height) {
  const double w = width;
  const double left = height - width;
  return w * w * w / 6.0 + 0.5 * w * w * left + 0.5 * w * left * left;
}

std::vector<Front> BuildFronts(const RowGraph& graph,
                               const std::vector<int>& order,
                               int num_trailing) {
  CHECK_EQ(static_cast<int>(order.size()), graph.num_vertices());
  return FrontBuilder(graph, order, num_trailing).Build();
}

}  // namespace ceres_ed
