// Drags one point of a square of four nodes to a landmark, and checks that it arrives.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/version.h>

#include <cstdio>
#include <vector>

using namespace ceres_ed;  // NOLINT(google-build-using-namespace): a program, not a header

int main() {
  DeformationGraph graph;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) graph.AddNode({x, y, 0.0});
  }
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) {
      if (j != k) graph.AddEdge({j, k, 1.0});
    }
  }
  const std::vector<Eigen::Vector3d> points = {{0.0, 0.0, 0.0}};
  Skinning skinning;
  const int nearest = 0;
  const double weight = 1.0;
  skinning.Add(&nearest, &weight, 1);
  Correspondence landmark;
  landmark.point = 0;
  landmark.target = {0.0, 0.0, 0.5};
  const std::vector<Correspondence> landmarks = {landmark};
  const std::vector<Correspondence> none;

  EnergyContext context;
  context.graph = &graph;
  context.points = &points;
  context.skinning = &skinning;
  context.correspondences = &none;
  context.landmarks = &landmarks;

  const EnergyRegistry registry = BuiltinEnergies();
  ProblemBuilder builder(graph, /*has_camera=*/false);
  for (const char* name : {"rotation", "regularization", "landmark"}) {
    const auto term = registry.Create(name, {});
    const int index = builder.AddTerm(name, (*term)->kind());
    builder.CollectResiduals(index, **term, context);
  }

  DeformationState state(graph.num_nodes());
  const SolveSummary summary = MakeStrategy({})->Solve(builder, {}, &state);
  const Eigen::Vector3d warped = WarpPoint(graph, state, skinning[0], points[0]);
  std::printf("ceres_ed %s: %s, distance to the landmark %.1e\n",
              kVersion,
              NameOf(summary.status).c_str(),
              (warped - landmark.target).norm());
  return summary.IsUsable() && (warped - landmark.target).norm() < 1e-3 ? 0 : 1;
}
