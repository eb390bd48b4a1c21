// The result of matching two surfaces.
#ifndef CERES_ED_REGISTRATION_MATCHES_H_
#define CERES_ED_REGISTRATION_MATCHES_H_

#include <ceres_ed/energy/correspondence.h>

#include <vector>

namespace ceres_ed {

// The pairs that a matching found, and their statistics.
struct Matches {
  std::vector<Correspondence> correspondences;
  // Further data of the pairs, by Correspondence::detail; empty if they were not requested.
  std::vector<MatchDetail> details;
  // The number of pairs with a closest point, and the number of pairs that were accepted.
  int candidates = 0;
  int inliers = 0;
  // The root mean square point-to-plane and point-to-point distance of the accepted pairs.
  double rms_plane = 0.0;
  double rms_point = 0.0;
  // 1.4826 times the median point-to-point distance of the candidates.
  double robust_distance = 0.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_MATCHES_H_
