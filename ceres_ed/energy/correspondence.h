// Matched pairs, as energies see them.
#ifndef CERES_ED_ENERGY_CORRESPONDENCE_H_
#define CERES_ED_ENERGY_CORRESPONDENCE_H_

#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map and where it was observed.
struct Correspondence {
  // Index into EnergyContext::points.
  int point = -1;
  // Index into EnergyContext::match_details; -1 where no more is known than what is here.
  int detail = -1;
  // In the camera frame where there is a camera, else in the map frame. Map units.
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  // Unit normal of the target surface in the same frame (a fit takes the mean of both surfaces');
  // zero where none is known.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  // >= 0, no unit: share of this observation in the sum.
  double weight = 1.0;
};

// What else is known of a matched pair. Vectors are in the frame of Correspondence::target.
struct MatchDetail {
  // Unit normals of the two surfaces, the source's as it was warped when the pair was matched; zero
  // where none is known. Signs may be at odds where a surface knows its normals only up to sign.
  Eigen::Vector3d source_normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_normal = Eigen::Vector3d::Zero();
  // Brightness of the point and of the target there, in [0, 1]; NaN where it isn't known.
  double source_intensity = std::numeric_limits<double>::quiet_NaN();
  double target_intensity = std::numeric_limits<double>::quiet_NaN();
  // How the target's brightness changes along its tangent plane, per map unit; zero where
  // target_intensity isn't known.
  Eigen::Vector3d intensity_gradient = Eigen::Vector3d::Zero();

  bool HasIntensities() const {
    return std::isfinite(source_intensity) && std::isfinite(target_intensity);
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_CORRESPONDENCE_H_
