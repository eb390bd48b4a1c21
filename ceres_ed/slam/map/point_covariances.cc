#include "ceres_ed/slam/map/point_covariances.h"

#include <ceres_ed/slam/checkpoint.h>

#include <cstddef>
#include <limits>

namespace ceres_ed {

void PointCovariances::Set(int slot, int id, const Eigen::Matrix3d& covariance) {
  if (static_cast<std::size_t>(slot) >= entries_.size()) entries_.resize(slot + 1);
  Entry& entry = entries_[slot];
  entry.id = id;
  int k = 0;
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      entry.upper[k++] = static_cast<float>(covariance(row, column));
    }
  }
}

Eigen::Matrix3d PointCovariances::At(int slot, const DeformableMap& map) const {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (static_cast<std::size_t>(slot) >= entries_.size()) return covariance;
  const Entry& entry = entries_[slot];
  if (!map.alive(slot) || entry.id != map.point(slot).id) return covariance;
  int k = 0;
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      covariance(row, column) = covariance(column, row) = entry.upper[k++];
    }
  }
  return covariance;
}

void PointCovariances::Exchange(CheckpointArchive* archive) {
  archive->Rows("point_covariances", &entries_);
}

}  // namespace ceres_ed
