// Changes of a map that do not come from a level.
#ifndef CERES_ED_TEST_SLAM_MAP_EDITS_H_
#define CERES_ED_TEST_SLAM_MAP_EDITS_H_

#include <ceres_ed/slam/map/deformable_map.h>

#include <algorithm>
#include <array>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// Calls edit(parameters) with a copy of a node's twelve parameters, which then become those of the
// node.
template <typename Edit>
void EditNode(DeformableMap* map, int node, Edit edit) {
  std::array<double, kNodeSize> parameters;
  std::copy_n(map->state().node(node), kNodeSize, parameters.begin());
  edit(parameters.data());
  map->SetNode(node, parameters.data());
}

inline void SetTranslation(DeformableMap* map, int node, const Eigen::Vector3d& translation) {
  EditNode(map, node, [&](double* p) { MutableNodeTranslation(p) = translation; });
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_SLAM_MAP_EDITS_H_
