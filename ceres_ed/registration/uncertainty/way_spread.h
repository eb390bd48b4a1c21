// How far apart the ways of a fit end.
#ifndef CERES_ED_REGISTRATION_UNCERTAINTY_WAY_SPREAD_H_
#define CERES_ED_REGISTRATION_UNCERTAINTY_WAY_SPREAD_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Collects where each way that a fit has followed puts the points of the source
// (hypotheses/portfolio.h). Two ways that explain the target nearly as well and end apart matched
// other parts: an error that no residual of one of them shows. Lengths are in the unit frame.
class WaySpread {
 public:
  // Adds the end of a way: where `state` of the nodes of `graph` puts `points`.
  void Add(const std::vector<Eigen::Vector3d>& points,
           const BuiltGraph& graph,
           const DeformationState& state,
           int num_threads);

  // Returns the mean of d d^T over the ways, where d leads from `place`, at which the fit has put
  // the point, to the end of a way; zero if there are none.
  Eigen::Matrix3d About(const Eigen::Vector3d& place, std::size_t point) const;

 private:
  std::vector<std::vector<Eigen::Vector3d>> ends_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_UNCERTAINTY_WAY_SPREAD_H_
