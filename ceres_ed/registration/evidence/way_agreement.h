// How far apart the ways end in which a fit has followed the target.
#ifndef CERES_ED_REGISTRATION_EVIDENCE_WAY_AGREEMENT_H_
#define CERES_ED_REGISTRATION_EVIDENCE_WAY_AGREEMENT_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Collects the ends of ways on coarse graphs of one source, and compares the two best of them.
class WayAgreement {
 public:
  // Adds the end `state` of a way on `graph`, which leaves the share `left` unexplained.
  void Add(const Surface& source,
           const BuiltGraph& graph,
           const DeformationState& state,
           double left);

  // Returns the mean distance between the points of the two ways that leave the least, in the unit
  // of the source; -1 if there are fewer than two.
  double Disagreement() const;

 private:
  struct End {
    double left = std::numeric_limits<double>::infinity();
    std::vector<Eigen::Vector3d> points;
  };
  End best_;
  End second_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_EVIDENCE_WAY_AGREEMENT_H_
