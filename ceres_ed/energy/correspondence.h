// Matched pairs of points, as they are passed to energies.
#ifndef CERES_ED_ENERGY_CORRESPONDENCE_H_
#define CERES_ED_ENERGY_CORRESPONDENCE_H_

#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map and the position at which it was observed.
struct Correspondence {
  // The index of the point in EnergyContext::points.
  int point = -1;
  // The index of more data about the pair in EnergyContext::match_details; -1 if there are none.
  int detail = -1;
  // The observed position, in map units. It is in the camera frame if there is a camera, otherwise
  // in the map frame.
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  // The unit normal of the target surface in the same frame; zero if it is unknown. (A fit uses the
  // mean of the normals of both surfaces.)
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  // The weight of this observation in the sum, >= 0, without a unit.
  double weight = 1.0;
};

// More data about a matched pair. Vectors are in the frame of Correspondence::target.
struct MatchDetail {
  // The unit normals of the two surfaces; zero if unknown. That of the source is taken from the
  // surface as it was warped when the pair was matched. The two may point to opposite sides if a
  // surface knows its normals only up to sign.
  Eigen::Vector3d source_normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_normal = Eigen::Vector3d::Zero();
  // The brightness of the point and of the target, in [0, 1]; NaN if unknown.
  double source_intensity = std::numeric_limits<double>::quiet_NaN();
  double target_intensity = std::numeric_limits<double>::quiet_NaN();
  // The gradient of the target's brightness along its tangent plane, per map unit; zero if
  // target_intensity is unknown.
  Eigen::Vector3d intensity_gradient = Eigen::Vector3d::Zero();

  // Returns whether the brightness of both is known.
  bool HasIntensities() const {
    return std::isfinite(source_intensity) && std::isfinite(target_intensity);
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_CORRESPONDENCE_H_
