// The points of a source that a fit watches, as the nodes move them.
#ifndef CERES_ED_REGISTRATION_MOVING_SAMPLES_H_
#define CERES_ED_REGISTRATION_MOVING_SAMPLES_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/matching.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Samples of a surface, warped by a graph over it. Both must outlive this.
class MovingSamples {
 public:
  MovingSamples(const Surface& source, const BuiltGraph& graph, int count);

  // Warps the samples, and returns how far they went in the mean since the last call (from rest at
  // the first one), in the unit of the surface; 0 without samples.
  double Move(const DeformationState& state, int num_threads);

  // Refers to this object.
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
