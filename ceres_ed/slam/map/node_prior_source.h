// Who says where nodes are thought to be.
#ifndef CERES_ED_SLAM_MAP_NODE_PRIOR_SOURCE_H_
#define CERES_ED_SLAM_MAP_NODE_PRIOR_SOURCE_H_

#include <ceres_ed/slam/map/deformable_map.h>

#include <vector>

namespace ceres_ed {

// Asked by a level for the nodes that it looks at, and for no others.
class NodePriorSource {
 public:
  virtual ~NodePriorSource() = default;

  // Brings map->node_prior() of these nodes up to date.
  virtual void UpdatePriors(const std::vector<int>& nodes, DeformableMap* map) = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_NODE_PRIOR_SOURCE_H_
