// The finish of a fit: what follows the nodes, for every vertex.
#ifndef CERES_ED_REGISTRATION_FINISH_FIT_FINISH_H_
#define CERES_ED_REGISTRATION_FINISH_FIT_FINISH_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/unit_fit.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Moves every vertex onto the target (vertex_finish.h) and lays folded faces flat (unfold.h). Both
// are displacements that the warp of the result keeps, so that whoever applies the warp repeats
// them. All arguments must outlive this object.
class FitFinish {
 public:
  // `source` is the input of the fit, in its own frame. `result` has the warp of the nodes.
  FitFinish(const UnitFit& fit,
            const PointCloud& source,
            const Similarity& unit_from_target,
            FitResult* result)
      : fit_(fit), source_(source), unit_from_target_(unit_from_target), result_(result) {}

  // Moves every vertex of `fitted` (the source as warped by the nodes with `state`) onto the
  // target. Fills in the distances of the matches and the time.
  void FinishEveryVertex(const DeformationState& state, PointCloud* fitted);

  // Lays folded faces of `fitted` flat. Fills in what the result says of folds.
  void Unfold(PointCloud* fitted);

  // Returns whether faces are known to be folded, or not known not to be.
  bool has_folds() const { return has_folds_; }

 private:
  void Report(const char* stage, double part) const;
  // Adds displacements (one per point, unit frame) to the finish of the warp, and applies the warp
  // again.
  void AddToFinish(const std::vector<Eigen::Vector3d>& displacements, PointCloud* fitted);

  const UnitFit& fit_;
  const PointCloud& source_;
  const Similarity& unit_from_target_;
  FitResult* result_;
  bool has_folds_ = true;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_FIT_FINISH_H_
