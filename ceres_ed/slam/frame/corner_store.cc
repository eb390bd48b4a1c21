#include "ceres_ed/slam/frame/corner_store.h"

#include <ceres_ed/util/memory_use.h>

#include <algorithm>
#include <utility>

namespace ceres_ed {

void CornerStore::Follow(int slot) {
  is_followed_[slot] = 1;
  followed_.push_back(slot);
}

void CornerStore::FollowOnly(std::vector<int> slots) {
  for (const int slot : followed_) is_followed_[slot] = 0;
  followed_ = std::move(slots);
  for (const int slot : followed_) is_followed_[slot] = 1;
}

const std::vector<int>& CornerStore::OfNode(int node) const {
  static const std::vector<int> none;
  return node < static_cast<int>(of_node_.size()) ? of_node_[node] : none;
}

void CornerStore::Add(const Corner& corner) {
  int slot = num_slots();
  if (free_.empty()) {
    corners_.emplace_back();
    is_followed_.push_back(0);
  } else {
    // The lowest one, so that a loaded state goes on like the saved one.
    slot = *free_.begin();
    free_.erase(free_.begin());
  }
  corners_[slot] = corner;
  corners_[slot].birth = births_++;
  Follow(slot);
  const int node = corner.nodes[0];
  if (node >= static_cast<int>(of_node_.size())) of_node_.resize(node + 1);
  // In ascending order, as in a state that was loaded.
  std::vector<int>& list = of_node_[node];
  list.insert(std::lower_bound(list.begin(), list.end(), slot), slot);
}

void CornerStore::Remove(int slot) {
  Corner& corner = corners_[slot];
  std::vector<int>& list = of_node_[corner.nodes[0]];
  list.erase(std::find(list.begin(), list.end(), slot));
  corner = Corner();
  free_.insert(slot);
}

bool CornerStore::AreBound(int num_nodes) const {
  return std::all_of(corners_.begin(), corners_.end(), [&](const Corner& corner) {
    return corner.num_nodes >= 0 && corner.num_nodes <= kMaxBoundNodes &&
           std::all_of(corner.nodes, corner.nodes + corner.num_nodes, [&](int node) {
             return node >= 0 && node < num_nodes;
           });
  });
}

void CornerStore::Index() {
  const auto outside = [&](int slot) { return slot < 0 || slot >= num_slots(); };
  followed_.erase(std::remove_if(followed_.begin(), followed_.end(), outside), followed_.end());
  is_followed_.assign(corners_.size(), 0);
  for (const int slot : followed_) is_followed_[slot] = 1;
  free_.clear();
  of_node_.clear();
  for (int slot = 0; slot < num_slots(); ++slot) {
    const Corner& corner = corners_[slot];
    if (corner.num_nodes == 0) {
      free_.insert(slot);
      continue;
    }
    if (corner.nodes[0] >= static_cast<int>(of_node_.size())) {
      of_node_.resize(corner.nodes[0] + 1);
    }
    of_node_[corner.nodes[0]].push_back(slot);
  }
}

std::size_t CornerStore::HeapBytes() const {
  return HeapBytesOf(corners_) + HeapBytesOf(is_followed_) + HeapBytesOfAll(of_node_);
}

}  // namespace ceres_ed
