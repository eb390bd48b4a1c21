#include "ceres_ed/slam/map/node_index.h"

#include <ceres_ed/util/memory_use.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// The width of the smallest cells, in map units. The cells of the next level are 2^kShift times as
// wide.
constexpr double kCellSize = 4.0;
constexpr int kShift = 3;
// A cell is given by three integers with this many bits, which are offset by kZero.
constexpr int kBits = 21;
constexpr std::int64_t kZero = std::int64_t{1} << (kBits - 1);
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

std::uint64_t KeyOf(const Eigen::Vector3d& position) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // A node that is so far away is out of reach of any camera.
    const double limit = static_cast<double>(kZero) - 1.0;
    const double cell = std::clamp(std::floor(position[axis] / kCellSize), -limit, limit);
    key = key << kBits | static_cast<std::uint64_t>(static_cast<std::int64_t>(cell) + kZero);
  }
  return key;
}

std::uint64_t ParentOf(std::uint64_t key) {
  std::uint64_t parent = 0;
  for (int axis = 2; axis >= 0; --axis) {
    parent = parent << kBits | (key >> (axis * kBits) & kMask) >> kShift;
  }
  return parent;
}

double CellSize(int level) { return kCellSize * (1 << (kShift * level)); }

Eigen::Vector3d CenterOf(std::uint64_t key, int level) {
  Eigen::Vector3d center;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<double>(key >> ((2 - axis) * kBits) & kMask);
    center[axis] = CellSize(level) * (cell + 0.5) - kCellSize * static_cast<double>(kZero);
  }
  return center;
}

}  // namespace

void NodeIndex::Place(int node, const Eigen::Vector3d& position) {
  const Key key = KeyOf(position);
  if (node == static_cast<int>(cell_of_node_.size())) {
    cell_of_node_.push_back(key);
  } else {
    if (cell_of_node_[node] == key) return;
    Remove(cell_of_node_[node], static_cast<Key>(node));
    cell_of_node_[node] = key;
  }
  Insert(key, static_cast<Key>(node));
}

// Adds `member` to a cell. A new cell is added to its parent, and so on.
void NodeIndex::Insert(Key key, Key member) {
  for (int level = 0; level < kLevels; ++level) {
    const auto [cell, is_new] = levels_[level].try_emplace(key);
    cell->second.members.push_back(member);
    if (!is_new) return;
    member = key;
    key = ParentOf(key);
  }
}

// Removes `member` from a cell. An empty cell is removed from its parent, and so on.
void NodeIndex::Remove(Key key, Key member) {
  for (int level = 0; level < kLevels; ++level) {
    const auto cell = levels_[level].find(key);
    std::vector<Key>& members = cell->second.members;
    members.erase(std::find(members.begin(), members.end(), member));
    if (!members.empty()) return;
    levels_[level].erase(cell);
    member = key;
    key = ParentOf(key);
  }
}

std::vector<int> NodeIndex::NearView(const ViewVolume& view, double reach) const {
  std::vector<int> nodes;
  std::vector<std::pair<int, Key>> open;
  for (const auto& [key, cell] : levels_[kLevels - 1]) open.emplace_back(kLevels - 1, key);
  while (!open.empty()) {
    const auto [level, key] = open.back();
    open.pop_back();
    const double half_diagonal = 0.5 * std::sqrt(3.0) * CellSize(level);
    if (!view.MayTouch(CenterOf(key, level), half_diagonal + reach)) continue;
    for (const Key member : levels_[level].at(key).members) {
      if (level > 0) {
        open.emplace_back(level - 1, member);
      } else {
        nodes.push_back(static_cast<int>(member));
      }
    }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::size_t NodeIndex::HeapBytes() const {
  std::size_t bytes = HeapBytesOf(cell_of_node_);
  for (const auto& level : levels_) {
    bytes += HeapBytesOf(level);
    for (const auto& [key, cell] : level) bytes += HeapBytesOf(cell.members);
  }
  return bytes;
}

}  // namespace ceres_ed
