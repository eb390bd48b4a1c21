// Samples of a source surface that move with the nodes during a fit.
#ifndef CERES_ED_REGISTRATION_MOVING_SAMPLES_H_
#define CERES_ED_REGISTRATION_MOVING_SAMPLES_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/matching.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Samples of a surface, warped by a graph on it. Both must outlive this object.
class MovingSamples {
 public:
  // Chooses about `count` points of `source`.
  MovingSamples(const Surface& source, const BuiltGraph& graph, int count);

  // Warps the samples. Returns the mean distance that they moved since the last call (at the first
  // call: from rest), in the unit of the surface; 0 if there are no samples.
  double Move(const DeformationState& state, int num_threads);

  // Returns the share of the surface's area that `state` squeezes away, in [0, 1]: the mean over
  // the samples, weighted by their areas, of the loss max(0, 1 - 2 r), where r is the ratio of a
  // patch's area to that at rest. A bend changes areas by far less than half; a part that is drawn
  // onto a surface that does not show it collapses.
  double LostArea(const DeformationState& state) const;

  // Returns the change of length that `state` exceeds in the part 1 - `quantile` of the samples: at
  // each of them it is the larger one of |log s| over the two singular values s of the warp in the
  // tangent plane. 0 if there are no samples; no value is above log 1000.
  double Stretch(const DeformationState& state, double quantile) const;

  // Returns the samples at their present positions; the result refers to this object.
  MovedSource Moved() const { return {source_, &samples_, &points_, &normals_}; }

 private:
  const Surface* source_;
  const BuiltGraph* graph_;
  std::vector<int> samples_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_MOVING_SAMPLES_H_
