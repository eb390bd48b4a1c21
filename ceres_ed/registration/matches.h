// What a matching of two surfaces found.
#ifndef CERES_ED_REGISTRATION_MATCHES_H_
#define CERES_ED_REGISTRATION_MATCHES_H_

#include <ceres_ed/energy/correspondence.h>

#include <vector>

namespace ceres_ed {

// What a matching found.
struct Matches {
  std::vector<Correspondence> correspondences;
  // By Correspondence::detail; empty where they weren't asked for.
  std::vector<MatchDetail> details;
  // Pairs that had a closest point at all, and those that were believed.
  int candidates = 0;
  int inliers = 0;
  // Root mean square point-to-plane and point-to-point distance of the inliers.
  double rms_plane = 0.0;
  double rms_point = 0.0;
  // 1.4826 times the median point-to-point distance of the candidates.
  double robust_distance = 0.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_MATCHES_H_
