// A search for maps between two surfaces that does not depend on their poses.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_MAP_SEARCH_H_
#define CERES_ED_REGISTRATION_INTRINSIC_MAP_SEARCH_H_

#include <ceres_ed/registration/intrinsic/functional_map.h>

#include <functional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A map with its cost.
struct RankedMap {
  // The images of the vertices input.source_order and input.target_order.
  PointMap map;
  // The mean difference of the signatures of a vertex and its image, in standard deviations.
  double cost = 0.0;
};

// What the search is given: bases and signatures (WaveKernelSignature) of both surfaces.
struct MapSearchInput {
  const SpectralBasis* source = nullptr;
  const SpectralBasis* target = nullptr;
  const Eigen::MatrixXd* source_signature = nullptr;
  const Eigen::MatrixXd* target_signature = nullptr;
  // The positions of the target's vertices.
  const std::vector<Eigen::Vector3d>* target_points = nullptr;
  // Evenly spread vertices, each prefix of which is evenly spread, too (farthest points first).
  std::vector<int> source_order;
  std::vector<int> target_order;
  // Polled between maps; if it returns true, the search ends with what it has. May be empty.
  std::function<bool()> should_stop;
};

// Returns up to `count` maps, the best first. For an isometry the
// functional map is diagonal with entries 1 and -1, except that functions with nearly the same
// eigenvalue may be rotated within their plane. So all signs of the first eigenfunctions are tried,
// with rotations in steps of 45 degrees for the two pairs whose eigenvalues are closest (an
// exhaustive form of the tree of Ren et al. 2020, "MapTree"). Those whose images have similar
// signatures are refined by ZoomOut. A body with a left and a right side has two good maps, of
// which one swaps the sides. The result does not depend on the signs of the eigenfunctions.
std::vector<RankedMap> SearchMaps(const MapSearchInput& input, int count);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_MAP_SEARCH_H_
