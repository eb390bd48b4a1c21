// The covariances of the points of a map, as the frames leave them.
#ifndef CERES_ED_SLAM_MAP_POINT_COVARIANCES_H_
#define CERES_ED_SLAM_MAP_POINT_COVARIANCES_H_

#include <ceres_ed/slam/map/deformable_map.h>

#include <array>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// One covariance for each slot of the map that has one, in squared map units.
class PointCovariances {
 public:
  // Keeps the covariance of the point in `slot`.
  void Set(int slot, int id, const Eigen::Matrix3d& covariance);

  // Returns the covariance of the point that is in `slot` now; NaN if none is known.
  Eigen::Matrix3d At(int slot, const DeformableMap& map) const;

  // Saves or loads all covariances.
  void Exchange(CheckpointArchive* archive);

 private:
  struct Entry {
    // The number of the point; slots are used again for other points. -1: none is known.
    int id = -1;
    // xx xy xz yy yz zz.
    std::array<float, 6> upper = {};
  };
  std::vector<Entry> entries_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_POINT_COVARIANCES_H_
