// Where the nodes are: finds those near the view without a look at the others.
#ifndef CERES_ED_SLAM_MAP_NODE_INDEX_H_
#define CERES_ED_SLAM_MAP_NODE_INDEX_H_

#include <ceres_ed/slam/map/view_volume.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Cells of cells in hash tables, only those that hold something. Lengths are in map units (node
// spacings); a node that moves within its cell costs a comparison.
class NodeIndex {
 public:
  // Adds a node, or takes note of where it has gone. Nodes are added in the order of their numbers.
  void Place(int node, const Eigen::Vector3d& position);

  // The nodes of every cell that comes within `reach` of the view, by number: all nodes that do,
  // and some more.
  std::vector<int> NearView(const ViewVolume& view, double reach) const;

  std::size_t HeapBytes() const;

 private:
  using Key = std::uint64_t;
  struct Cell {
    // Nodes of a cell of the lowest level, cells of the next lower one of any other.
    std::vector<Key> members;
  };
  static constexpr int kLevels = 4;

  void Insert(Key key, Key member);
  void Remove(Key key, Key member);

  std::array<std::unordered_map<Key, Cell>, kLevels> levels_;
  // Of each node, the cell of the lowest level.
  std::deque<Key> cell_of_node_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_NODE_INDEX_H_
