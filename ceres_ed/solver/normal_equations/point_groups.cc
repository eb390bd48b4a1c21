#include "ceres_ed/solver/normal_equations/point_groups.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace ceres_ed {
namespace {

// Returns the point store of a residual, or null if it does not belong to one.
const PointStore* AsPoint(const SelectedResidual& residual) {
  const bool is_point =
      residual.store != nullptr && residual.store->form() == ResidualStore::Form::kPoint;
  return is_point ? static_cast<const PointStore*>(residual.store) : nullptr;
}

// Returns the positions in [0, n), sorted by their nodes.
std::array<int, kMaxBoundNodes> NodeOrder(const BlockRef* blocks, int num_nodes) {
  std::array<int, kMaxBoundNodes> order{};
  for (int i = 0; i < num_nodes; ++i) {
    int k = i;
    for (; k > 0 && blocks[order[k - 1]].node > blocks[i].node; --k) order[k] = order[k - 1];
    order[k] = i;
  }
  return order;
}

std::size_t Hash(const int* nodes, int num_nodes, bool has_camera) {
  std::uint64_t hash = has_camera ? 1 : 0;
  for (int i = 0; i < num_nodes; ++i) {
    hash = (hash ^ static_cast<std::uint64_t>(nodes[i])) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
}

constexpr std::size_t kSmallestTable = 64;

}  // namespace

void PointGroups::Build(const DeformationGraph& graph,
                        const std::vector<SelectedResidual>& residuals) {
  groups_.clear();
  nodes_.clear();
  found_.clear();
  max_residuals_ = 0;
  point_of_residual_.clear();
  group_table_.assign(std::max(group_table_.size(), kSmallestTable), -1);
  std::fill(point_of_index_.begin(), point_of_index_.end(), -1);
  for (const SelectedResidual& residual : residuals) {
    const PointStore* store = AsPoint(residual);
    if (store == nullptr) continue;
    max_residuals_ = std::max(max_residuals_, store->num_residuals());
    int point = FindPoint(residual, *store);
    if (point < 0) point = AddPoint(residual, *store);
    point_of_residual_.push_back(point);
  }
  PlacePoints(graph);
  PlaceResiduals(residuals);
}

int PointGroups::FindPoint(const SelectedResidual& residual, const PointStore& store) {
  const StoredPoint& point = store.point(residual.index);
  const auto index = static_cast<std::size_t>(point.index);
  if (index >= point_of_index_.size()) {
    point_of_index_.resize(std::max(index + 1, 2 * point_of_index_.size()), -1);
  }
  const int found = point_of_index_[index];
  if (found < 0) {
    point_of_index_[index] = static_cast<int>(found_.size());
    return -1;
  }
  // Residuals may come from different contexts, in which the same index means another point.
  const StoredPoint& other = found_[found].store->point(found_[found].index);
  if (other.position != point.position || other.num_nodes != point.num_nodes ||
      other.has_camera != point.has_camera) {
    return -1;
  }
  const double* weights = store.weights(residual.index);
  const double* other_weights = found_[found].store->weights(found_[found].index);
  for (int i = 0; i < point.num_nodes; ++i) {
    if (weights[i] != other_weights[i] || residual.blocks[i].node != found_[found].blocks[i].node) {
      return -1;
    }
  }
  return found;
}

int PointGroups::FindOrAddGroup(const int* sorted_nodes, int num_nodes, bool has_camera) {
  const std::size_t mask = group_table_.size() - 1;
  std::size_t slot = Hash(sorted_nodes, num_nodes, has_camera) & mask;
  for (; group_table_[slot] >= 0; slot = (slot + 1) & mask) {
    const PointGroup& group = groups_[group_table_[slot]];
    if (group.num_nodes == num_nodes && group.has_camera == has_camera &&
        std::equal(sorted_nodes, sorted_nodes + num_nodes, nodes(group))) {
      return group_table_[slot];
    }
  }
  const int added = static_cast<int>(groups_.size());
  group_table_[slot] = added;
  PointGroup group;
  group.first_node = static_cast<int>(nodes_.size());
  group.num_nodes = num_nodes;
  group.has_camera = has_camera;
  groups_.push_back(group);
  nodes_.insert(nodes_.end(), sorted_nodes, sorted_nodes + num_nodes);
  if (2 * groups_.size() > group_table_.size()) GrowGroupTable();
  return added;
}

void PointGroups::GrowGroupTable() {
  group_table_.assign(2 * group_table_.size(), -1);
  const std::size_t mask = group_table_.size() - 1;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    std::size_t slot = Hash(nodes(groups_[g]), groups_[g].num_nodes, groups_[g].has_camera) & mask;
    while (group_table_[slot] >= 0) slot = (slot + 1) & mask;
    group_table_[slot] = static_cast<int>(g);
  }
}

int PointGroups::AddPoint(const SelectedResidual& residual, const PointStore& store) {
  const StoredPoint& point = store.point(residual.index);
  const std::array<int, kMaxBoundNodes> order = NodeOrder(residual.blocks, point.num_nodes);
  std::array<int, kMaxBoundNodes> sorted_nodes;
  for (int i = 0; i < point.num_nodes; ++i) sorted_nodes[i] = residual.blocks[order[i]].node;
  const int group = FindOrAddGroup(sorted_nodes.data(), point.num_nodes, point.has_camera);
  found_.push_back({&store, residual.blocks, residual.index, group, groups_[group].num_points++});
  return static_cast<int>(found_.size()) - 1;
}

void PointGroups::PlacePoints(const DeformationGraph& graph) {
  int num_points = 0;
  int num_weights = 0;
  max_points_ = 0;
  for (PointGroup& group : groups_) {
    group.first_point = num_points;
    group.first_weight = num_weights;
    num_points += group.num_points;
    num_weights += group.num_points * group.num_nodes;
    max_points_ = std::max(max_points_, group.num_points);
  }
  levers_.resize(num_points);
  weights_.resize(num_weights);
  for (const Point& point : found_) {
    const PointGroup& group = groups_[point.group];
    levers_[group.first_point + point.place] =
        point.store->point(point.index).position - graph.position(nodes(group)[0]);
    const std::array<int, kMaxBoundNodes> order = NodeOrder(point.blocks, group.num_nodes);
    const double* weights = point.store->weights(point.index);
    double* placed = &weights_[group.first_weight + point.place * group.num_nodes];
    for (int i = 0; i < group.num_nodes; ++i) placed[i] = weights[order[i]];
  }
}

// Stores the residuals by group; within a group they keep their order, which is by term and store.
void PointGroups::PlaceResiduals(const std::vector<SelectedResidual>& residuals) {
  next_residual_.assign(groups_.size() + 1, 0);
  for (const int point : point_of_residual_) ++next_residual_[found_[point].group + 1];
  for (std::size_t g = 0; g < groups_.size(); ++g) next_residual_[g + 1] += next_residual_[g];
  indices_.resize(point_of_residual_.size());
  points_.resize(point_of_residual_.size());
  residual_weights_.resize(point_of_residual_.size());
  std::vector<PointRun>& runs = placed_runs_;
  runs.resize(point_of_residual_.size());
  std::size_t k = 0;
  for (const SelectedResidual& residual : residuals) {
    const PointStore* store = AsPoint(residual);
    if (store == nullptr) continue;
    const Point& point = found_[point_of_residual_[k++]];
    const int place = next_residual_[point.group]++;
    indices_[place] = residual.index;
    points_[place] = point.place;
    residual_weights_[place] = residual.weight;
    runs[place] = {store, residual.term, place, 1};
  }
  runs_.clear();
  std::size_t begin = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    groups_[g].first_run = static_cast<int>(runs_.size());
    for (const auto end = static_cast<std::size_t>(next_residual_[g]); begin < end; ++begin) {
      const bool joins = static_cast<int>(runs_.size()) > groups_[g].first_run &&
                         runs_.back().store == runs[begin].store &&
                         runs_.back().term == runs[begin].term;
      if (joins) {
        ++runs_.back().num_residuals;
      } else {
        runs_.push_back(runs[begin]);
      }
    }
    groups_[g].num_runs = static_cast<int>(runs_.size()) - groups_[g].first_run;
  }
}

}  // namespace ceres_ed
