// The similarity transform: rotation, translation and scale.
#ifndef CERES_ED_GEOMETRY_SIMILARITY_H_
#define CERES_ED_GEOMETRY_SIMILARITY_H_

#include <ceres_ed/util/status.h>

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// A similarity b_from_a: point_in_b = scale * (rotation * point_in_a) + translation. It is the
// identity by default.
struct Similarity {
  double scale = 1.0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  // The translation, in the unit of frame b.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  // Returns the point in frame b.
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return scale * (rotation * point) + translation;
  }
  // Returns the composition: c_from_b * b_from_a = c_from_a.
  Similarity operator*(const Similarity& other) const;
  // Returns a_from_b. Fails a CHECK if the scale is 0.
  Similarity Inverse() const;

  // Returns the similarity S that minimises the sum of |S * from_i - to_i|^2 (Umeyama 1991). The
  // scale is 1 unless `with_scale`, and the rotation is always proper. Returns an error if there
  // are fewer than three pairs, if a point is not finite, and if the points lie on one line, where
  // the rotation is not determined. Fails a CHECK if `from` and `to` differ in size.
  static StatusOr<Similarity> FitPoints(const std::vector<Eigen::Vector3d>& from,
                                        const std::vector<Eigen::Vector3d>& to,
                                        bool with_scale = false);
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SIMILARITY_H_
