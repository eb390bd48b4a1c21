// New points where the camera sees what the map lacks, and new nodes where coverage ends.
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

struct MapGrowthResult {
  int new_points = 0;
  int new_nodes = 0;
};

// Binds places on the map, as it is deformed now, to the nodes nearest to them (Eq. 2).
class PlaceBinder {
 public:
  // Knows the nodes near the view.
  PlaceBinder(const DeformableMap& map,
              const CameraPose& camera_from_map,
              const PinholeCamera& camera);

  // Adds a node that is new in the map.
  void AddNode(const DeformableMap& map, int node);
  bool empty() const { return nodes_.empty(); }
  // Distance to the nearest node; infinite when there is none.
  double DistanceTo(const Eigen::Vector3d& place) const;
  // The `count` nearest nodes, nearest first.
  std::vector<int> Nearest(const Eigen::Vector3d& place, int count) const;
  // A binding of `neighbors` nodes; valid until the next call. Needs one node at least.
  Binding Bind(const Eigen::Vector3d& place, int neighbors);

 private:
  std::vector<int> nodes_;
  std::vector<Eigen::Vector3d> positions_;
  // For Bind().
  int bound_nodes_[kMaxBoundNodes];
  double weights_[kMaxBoundNodes];
};

// Adds to the map what `surface` shows and `visible` points don't cover.
MapGrowthResult GrowMap(const std::vector<VisiblePoint>& visible,
                        const ObservedSurface& surface,
                        ColorView color,
                        int frame,
                        const MapGrowthOptions& options,
                        DeformableMap* map);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_MAP_GROWTH_H_
