// Where a rigid alignment may start from.
#ifndef CERES_ED_REGISTRATION_RIGID_RIGID_STARTS_H_
#define CERES_ED_REGISTRATION_RIGID_RIGID_STARTS_H_

#include <ceres_ed/geometry/similarity.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Poses to try beside `initial`, all with its scale and with the centroids aligned: first its own
// orientation, then the principal axes aligned in their four proper ways. Neither set of points is
// empty.
std::vector<Similarity> RigidStarts(const std::vector<Eigen::Vector3d>& source,
                                    const std::vector<Eigen::Vector3d>& target,
                                    const Similarity& initial);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_RIGID_STARTS_H_
