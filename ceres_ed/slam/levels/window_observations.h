// The observations of a frame over a window of the graph, in the form that energies use.
#ifndef CERES_ED_SLAM_LEVELS_WINDOW_OBSERVATIONS_H_
#define CERES_ED_SLAM_LEVELS_WINDOW_OBSERVATIONS_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/slam/levels/level_window.h>
#include <ceres_ed/slam/levels/levels.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Points, bindings and priors with the indices of the window.
class WindowObservations {
 public:
  // `windows` must have built `window` as its last one.
  WindowObservations(const FrameObservations& observations,
                     const LevelWindowBuilder& windows,
                     const DeformableMap& map,
                     const LevelWindow& window);

  // Returns a context that refers to this object, which must outlive it.
  EnergyContext Context(const LevelWindow& window) const;

  // The corners that are followed.
  const std::vector<Correspondence>& features() const { return features_; }
  int num_planes() const { return static_cast<int>(planes_.size()); }

 private:
  std::vector<Correspondence> Take(const std::vector<MapObservation>& observations,
                                   const LevelWindowBuilder& windows);

  std::vector<Eigen::Vector3d> points_;
  Skinning skinning_;
  std::vector<Correspondence> planes_;
  std::vector<Correspondence> features_;
  std::vector<MatchDetail> details_;
  std::vector<Eigen::Vector3d> node_prior_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_WINDOW_OBSERVATIONS_H_
