// Adds new points where the camera sees something that the map lacks, and new nodes where the
// coverage by nodes ends.
#ifndef CERES_ED_SLAM_FRAME_MAP_GROWTH_H_
#define CERES_ED_SLAM_FRAME_MAP_GROWTH_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/slam_options.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The numbers of points and nodes that GrowMap() added.
struct MapGrowthResult {
  int new_points = 0;
  int new_nodes = 0;
  // The share of the observed surface that `visible` points already covered.
  double explained = 0.0;
};

// Binds positions on the map, in its present deformation, to the nearest nodes (Eq. 2).
class PlaceBinder {
 public:
  // Uses the nodes near the view.
  PlaceBinder(const DeformableMap& map,
              const CameraPose& camera_from_map,
              const PinholeCamera& camera);

  // Adds a node that is new in the map.
  void AddNode(const DeformableMap& map, int node);
  bool empty() const { return nodes_.empty(); }
  // Returns the distance to the nearest node, or infinity if there are no nodes.
  double DistanceTo(const Eigen::Vector3d& place) const;
  // Returns the `count` nearest nodes, nearest first.
  std::vector<int> Nearest(const Eigen::Vector3d& place, int count) const;
  // Returns a binding to `neighbors` nodes, which is valid until the next call. At least one node
  // is required.
  Binding Bind(const Eigen::Vector3d& place, int neighbors);

 private:
  std::vector<int> nodes_;
  std::vector<Eigen::Vector3d> positions_;
  // The memory of the result of Bind().
  int bound_nodes_[kMaxBoundNodes];
  double weights_[kMaxBoundNodes];
};

// Adds to the map the parts of `surface` that no `visible` point covers.
MapGrowthResult GrowMap(const std::vector<VisiblePoint>& visible,
                        const ObservedSurface& surface,
                        ColorView color,
                        int frame,
                        const MapGrowthOptions& options,
                        DeformableMap* map);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_MAP_GROWTH_H_
