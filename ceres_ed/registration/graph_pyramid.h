// The graphs of a fit, from few nodes to many.
#ifndef CERES_ED_REGISTRATION_GRAPH_PYRAMID_H_
#define CERES_ED_REGISTRATION_GRAPH_PYRAMID_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/unit_fit.h>
#include <ceres_ed/util/status.h>

#include <vector>

namespace ceres_ed {

// Graphs on one source. Each has half the node spacing of the one before it.
class GraphPyramid {
 public:
  // Builds up to `resolutions` >= 1 graphs; a body with few nodes has no coarser graph, and a fit
  // that must end has a graph of a few nodes alone. Fills in the time, the warnings and, if the fit
  // must end, the status of `result`. `fit` must outlive the pyramid. It is an error if no graph
  // can be built on the source.
  static StatusOr<GraphPyramid> Build(const UnitFit& fit, int resolutions, FitResult* result);

  // Returns the number of graphs, at least one, and the index of the finest one.
  int size() const { return static_cast<int>(graphs_.size()); }
  int finest() const { return size() - 1; }

  const BuiltGraph& operator[](int resolution) const { return graphs_[resolution]; }

  // Returns the state of the nodes of the graph `to` under the warp by `state` of the graph `from`:
  // each node takes over the value and the gradient of that warp.
  DeformationState CarryOver(const DeformationState& state, int from, int to) const;

 private:
  explicit GraphPyramid(const UnitFit& fit) : fit_(&fit) {}

  const UnitFit* fit_;
  std::vector<BuiltGraph> graphs_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_GRAPH_PYRAMID_H_
