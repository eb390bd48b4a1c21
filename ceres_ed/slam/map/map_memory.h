// The memory that a map occupies, by part.
#ifndef CERES_ED_SLAM_MAP_MAP_MEMORY_H_
#define CERES_ED_SLAM_MAP_MAP_MEMORY_H_

#include <cstddef>

namespace ceres_ed {

// Bytes on the heap of everything that grows with the map: the capacity of the containers, whether
// it is used or not, rounded up like the allocator does. Temporary memory of a frame is not
// included.
struct MapMemory {
  // Rest positions, states and priors of the nodes.
  std::size_t nodes = 0;
  // Edges, and for each node the list of its edges.
  std::size_t edges = 0;
  std::size_t node_index = 0;
  // The positions of nodes at the times when they were seen (TissueMemory).
  std::size_t tissue_memory = 0;
  // The data that the levels store for every node: unsettled changes, motion, and the place in the
  // window.
  std::size_t levels = 0;

  std::size_t points = 0;
  std::size_t bindings = 0;
  // For each node the points that are bound most strongly to it, and the free slots.
  std::size_t point_lists = 0;

  std::size_t OfNodes() const { return nodes + edges + node_index + tissue_memory + levels; }
  std::size_t OfPoints() const { return points + bindings + point_lists; }
  std::size_t Total() const { return OfNodes() + OfPoints(); }
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_MAP_MEMORY_H_
