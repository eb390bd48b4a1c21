// What a map holds in memory, by owner.
#ifndef CERES_ED_SLAM_MAP_MAP_MEMORY_H_
#define CERES_ED_SLAM_MAP_MAP_MEMORY_H_

#include <cstddef>

namespace ceres_ed {

// Bytes on the heap, of all that grows with the map: by what the containers have room for, whether
// it is in use or not, and as the allocator rounds it. What a frame makes and drops isn't in it.
struct MapMemory {
  // Rest positions, states and priors.
  std::size_t nodes = 0;
  // Edges, and of each node those that touch it.
  std::size_t edges = 0;
  std::size_t node_index = 0;
  // Where nodes were while they were seen.
  std::size_t tissue_memory = 0;
  // What the levels know of every node: what is unsettled, what was moved, its place in the window.
  std::size_t levels = 0;

  std::size_t points = 0;
  std::size_t bindings = 0;
  // Of each node those that are bound to it most, and slots that are free.
  std::size_t point_lists = 0;

  std::size_t OfNodes() const { return nodes + edges + node_index + tissue_memory + levels; }
  std::size_t OfPoints() const { return points + bindings + point_lists; }
  std::size_t Total() const { return OfNodes() + OfPoints(); }
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_MAP_MEMORY_H_
