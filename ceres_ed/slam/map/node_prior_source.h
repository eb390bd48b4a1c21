// The interface to a source of expected node positions.
#ifndef CERES_ED_SLAM_MAP_NODE_PRIOR_SOURCE_H_
#define CERES_ED_SLAM_MAP_NODE_PRIOR_SOURCE_H_

#include <ceres_ed/slam/map/deformable_map.h>

#include <vector>

namespace ceres_ed {

// Provides the expected positions of nodes. A level calls it only for the nodes that it uses.
class NodePriorSource {
 public:
  virtual ~NodePriorSource() = default;

  // Updates map->node_prior() of these nodes.
  virtual void UpdatePriors(const std::vector<int>& nodes, DeformableMap* map) = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_NODE_PRIOR_SOURCE_H_
