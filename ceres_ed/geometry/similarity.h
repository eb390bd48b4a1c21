// Rotation, translation and scale.
#ifndef CERES_ED_GEOMETRY_SIMILARITY_H_
#define CERES_ED_GEOMETRY_SIMILARITY_H_

#include <ceres_ed/util/status.h>

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// b_from_a: point_in_b = scale * (rotation * point_in_a) + translation. Identity by default.
struct Similarity {
  double scale = 1.0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  // In the unit of frame b.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  // The point in frame b.
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return scale * (rotation * point) + translation;
  }
  // c_from_b * b_from_a = c_from_a.
  Similarity operator*(const Similarity& other) const;
  // a_from_b.
  Similarity Inverse() const;

  // The similarity (scale 1 unless `with_scale`) that minimises the sum of |S * from_i - to_i|^2
  // (Umeyama 1991), a proper rotation always. Fails on fewer than three pairs, and on points that
  // lie on one line, where the rotation is not determined.
  static StatusOr<Similarity> FitPoints(const std::vector<Eigen::Vector3d>& from,
                                        const std::vector<Eigen::Vector3d>& to,
                                        bool with_scale = false);
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SIMILARITY_H_
