// Initial poses for a rigid alignment.
#ifndef CERES_ED_REGISTRATION_RIGID_RIGID_STARTS_H_
#define CERES_ED_REGISTRATION_RIGID_RIGID_STARTS_H_

#include <ceres_ed/geometry/similarity.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns poses to try in addition to `initial`, all with its scale and with aligned centroids:
// first with the orientation of `initial`, then with the principal axes aligned in their four
// proper ways. Both sets of points must not be empty.
std::vector<Similarity> RigidStarts(const std::vector<Eigen::Vector3d>& source,
                                    const std::vector<Eigen::Vector3d>& target,
                                    const Similarity& initial);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_RIGID_STARTS_H_
