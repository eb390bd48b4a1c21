// A strip of which one half is seen, as a map with observations and as problems over the whole
// graph.
#ifndef CERES_ED_TEST_SLAM_LEVEL_SCENES_H_
#define CERES_ED_TEST_SLAM_LEVEL_SCENES_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/slam/levels/levels.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>
#include <test/slam/map_edits.h>

namespace ceres_ed {

// 14 x 4 nodes (or another number of columns) with a small deformation. The first three columns of
// cells are seen, which gives 16 PR nodes. The targets are farther away than the widths of the
// losses.
struct LevelScene {
  explicit LevelScene(int columns = 14) : problem(MakeTestProblem(Options(columns))) {
    const DeformationState start = RandomState(problem, 0.05, 9);
    for (int j = 0; j < problem.graph.num_nodes(); ++j) {
      const Eigen::Vector3d g = problem.graph.position(j);
      map.AddNode(g, g + NodeTranslation(start.node(j)), NodeAffine(start.node(j)));
      // The expected position of a node differs from its present one.
      SetTranslation(&map, j, NodeTranslation(start.node(j)) + Eigen::Vector3d(0.02, -0.01, 0.03));
      node_prior.push_back(map.node_prior(j));
    }
    // One edge of each pair.
    for (const GraphEdge& edge : problem.graph.edges()) {
      if (edge.from < edge.to) map.Connect(edge.from, edge.to);
    }
    map.SetCamera(start.camera_from_map);
    observations.camera_prior = start.camera_from_map;
    observations.planes = Take(problem.correspondences);
    // Every third observation is also used point to point.
    for (std::size_t k = 0; k < problem.correspondences.size(); k += 3) {
      landmarks.push_back(problem.correspondences[k]);
    }
    observations.features = Take(landmarks);
    observations.plane_width = 0.2;
    observations.feature_width = 0.4;
  }

  static TestProblemOptions Options(int columns) {
    TestProblemOptions options;
    options.columns = columns;
    options.rows = 4;
    options.points_per_cell = 5;
    options.observed_columns = 3;
    options.has_camera = true;
    options.target_deviation = 0.1;
    return options;
  }

  std::vector<MapObservation> Take(const std::vector<Correspondence>& correspondences) const {
    std::vector<MapObservation> taken;
    for (const Correspondence& c : correspondences) {
      taken.push_back({problem.points[c.point],
                       PointBinding(problem.skinning[c.point]),
                       c.target,
                       c.normal,
                       c.weight});
    }
    return taken;
  }

  // Returns a problem over the whole graph with the terms of LevelsOptions, at the present state.
  std::unique_ptr<ProblemBuilder> WholeProblem(const LevelsOptions& options) const {
    const EnergyRegistry registry = BuiltinEnergies();
    EnergyContext context = problem.Context();
    context.graph = &map.graph();
    context.landmarks = &landmarks;
    context.camera_prior = map.state().camera_from_map;
    context.node_prior = &node_prior;
    auto builder = std::make_unique<ProblemBuilder>(map.graph(), /*has_camera=*/true);
    const auto add = [&](const std::string& name,
                         double weight,
                         const LossSpec& loss = {},
                         const std::map<std::string, double>& parameters = {}) {
      const auto energy = registry.Create(name, parameters);
      CHECK(energy.ok()) << energy.status().message();
      const int term = builder->AddTerm(name, (*energy)->kind(), weight, loss);
      builder->CollectResiduals(term, **energy, context);
    };
    add("rotation", options.rotation_weight);
    add("regularization", options.regularization_weight);
    add("node_prior", options.node_prior_weight);
    // The weight of the data is per PR node, of which there are 16.
    const double data = options.plane_weight * 16.0 / problem.correspondences.size();
    add("point_to_plane", data, {LossType::kTukey, observations.plane_width});
    add("landmark", data * options.feature_weight, {LossType::kTukey, observations.feature_width});
    add("pose_prior",
        1.0,
        {},
        {{"rotation_sigma", options.prior_rotation_deg},
         {"translation_sigma", options.prior_translation}});
    return builder;
  }

  TestProblem problem;
  std::vector<Correspondence> landmarks;
  DeformableMap map;
  std::vector<Eigen::Vector3d> node_prior;
  // The bindings refer to `problem`.
  FrameObservations observations;
};

// Returns the largest difference of a parameter, or at least 1 if the numbers of parameters differ.
inline double LargestDifference(const DeformationState& a, const DeformationState& b) {
  const std::vector<double> x = AllParameters(a);
  const std::vector<double> y = AllParameters(b);
  double largest = x.size() == y.size() ? 0.0 : 1.0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i] - y[i]));
  return largest;
}

// Returns options for exactly three steps, whatever they gain. The same steps from the same start
// are equal up to rounding, whereas the end of a converged search is known only to the square root
// of the rounding error.
inline LevelsOptions ThreeSteps(int rings, BoundaryEdges boundary_edges) {
  LevelsOptions options;
  options.strategy.rings = rings;
  options.strategy.boundary_edges = boundary_edges;
  options.solver.max_iterations = 3;
  options.solver.function_tolerance = 0.0;
  options.solver.gradient_tolerance = 0.0;
  options.solver.parameter_tolerance = 0.0;
  return options;
}

// Returns options with which a solve goes as far as the digits of the energy allow.
inline LevelsOptions ExactLevels(int rings, BoundaryEdges boundary_edges) {
  LevelsOptions options;
  options.strategy.rings = rings;
  options.strategy.boundary_edges = boundary_edges;
  options.solver.max_iterations = 300;
  options.solver.function_tolerance = 0.0;
  options.solver.gradient_tolerance = 1e-14;
  options.solver.parameter_tolerance = 1e-14;
  return options;
}

inline std::unique_ptr<Levels> MakeLevels(const LevelsOptions& options) {
  const EnergyRegistry registry = BuiltinEnergies();
  StatusOr<std::unique_ptr<Levels>> levels = Levels::Create(options, registry);
  CHECK(levels.ok()) << levels.status().message();
  return *std::move(levels);
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_SLAM_LEVEL_SCENES_H_
