// A spatial index of the nodes, which finds those near the view without visiting the others.
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

// A hierarchy of cubic cells in hash tables, which contain non-empty cells only. Lengths are in map
// units (node spacings). A node that moves within its cell costs one comparison.
class NodeIndex {
 public:
  // Adds a node, or updates its position. Nodes must be added in the order of their numbers.
  void Place(int node, const Eigen::Vector3d& position);

  // Returns, in ascending order, the nodes of every cell that comes within `reach` of the view.
  // These are all nodes within that distance, and some more.
  std::vector<int> NearView(const ViewVolume& view, double reach) const;

  std::size_t HeapBytes() const;

 private:
  using Key = std::uint64_t;
  struct Cell {
    // On the lowest level the nodes of the cell; on other levels its cells on the next lower level.
    std::vector<Key> members;
  };
  static constexpr int kLevels = 4;

  void Insert(Key key, Key member);
  void Remove(Key key, Key member);

  std::array<std::unordered_map<Key, Cell>, kLevels> levels_;
  // The cell of each node on the lowest level.
  std::deque<Key> cell_of_node_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_NODE_INDEX_H_
