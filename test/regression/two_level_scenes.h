// Half-seen surfaces with known correspondences, and their solves.
#ifndef CERES_ED_TEST_REGRESSION_TWO_LEVEL_SCENES_H_
#define CERES_ED_TEST_REGRESSION_TWO_LEVEL_SCENES_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/simulation/views.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/residual_collection.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <test/geometry/meshes.h>

namespace ceres_ed {

// A surface at rest, where its points really go, and which of them are seen. Node spacings are the
// unit of length.
struct RegressionScene {
  std::string name;
  PointCloud rest;
  std::vector<Eigen::Vector3d> truth;
  std::vector<char> visible;
  BuiltGraph graph;
};

inline RegressionScene CompleteScene(RegressionScene scene, int nodes) {
  GraphOptions options;
  options.target_nodes = nodes;
  StatusOr<BuiltGraph> graph = BuildGraph(scene.rest, options);
  CHECK(graph.ok()) << graph.status().message();
  const double unit = 1.0 / graph->node_spacing;
  for (Eigen::Vector3d& point : scene.rest.points) point *= unit;
  for (Eigen::Vector3d& point : scene.truth) point *= unit;
  // Scaling points and spacing together changes nothing but the positions.
  options.target_nodes = 0;
  options.node_spacing = 1.0;
  graph = BuildGraph(scene.rest, options);
  CHECK(graph.ok()) << graph.status().message();
  scene.graph = *std::move(graph);
  return scene;
}

// A strip 120 x 14 whose left third is seen. It bends out of its plane, more so toward the left,
// with waves along it.
inline RegressionScene MakeStripScene(double phase = 1.0) {
  RegressionScene scene;
  scene.name = "strip";
  scene.rest = MakeGridMesh(121, 15);
  for (const Eigen::Vector3d& p : scene.rest.points) {
    const double x = p.x() / 120.0;
    const double lift =
        6.0 * (1.0 - x) * (1.0 - x) + 1.5 * std::sin(9.0 * x + 2.0) + 0.05 * p.y() * (1.0 - x);
    scene.truth.push_back(p + phase * Eigen::Vector3d(2.0 * (1.0 - x), 0.5, lift));
    scene.visible.push_back(x < 0.35);
  }
  return CompleteScene(std::move(scene), 240);
}

inline RegressionScene MakeShapeScene(SyntheticShape shape, const SyntheticView& view, int nodes) {
  RegressionScene scene;
  scene.name = SyntheticShapeName(shape);
  const double size = DefaultSyntheticSize(shape);
  scene.rest = MakeSyntheticShape(shape, 1500, size);
  const PointCloud truth = DeformSyntheticShape(shape, size, 1.0, scene.rest);
  scene.visible = VisibleVertices(truth, view);
  scene.truth = truth.points;
  return CompleteScene(std::move(scene), nodes);
}

// The plane with bumps, of which a window in a corner is seen.
inline RegressionScene MakePlaneScene() {
  SyntheticView view;
  view.eye = {-0.05, -0.05, 0.15};
  view.look_at = {-0.05, -0.05, 0.0};
  view.half_angle_deg = 20.0;
  return MakeShapeScene(SyntheticShape::kPlane, view, 200);
}

// The heart, of which the front is seen.
inline RegressionScene MakeHeartScene() {
  SyntheticView view;
  view.eye = {0.0, -0.3, 0.0};
  return MakeShapeScene(SyntheticShape::kHeart, view, 200);
}

// What a solve did to a scene. Distances in node spacings.
struct SceneResult {
  double energy = 0.0;
  // Root mean square distance of seen and of hidden points to the truth.
  double visible_rms = 0.0;
  double hidden_rms = 0.0;
  std::vector<Eigen::Vector3d> points;
  SolveSummary summary;
  DeformationState state;
};

// Eq. 3 with the weights of Sumner et al. (2007): E_rot 1, E_reg 10, E_data 100, over a scene that
// must outlive this. No camera: the gauge is settled.
class SceneProblem {
 public:
  explicit SceneProblem(const RegressionScene& scene,
                        const std::string& data_energy = "point_to_point")
      : scene_(scene), builder_(scene.graph.graph, /*has_camera=*/false) {
    PointCloud truth = scene.rest;
    truth.points = scene.truth;
    const std::vector<Eigen::Vector3d> normals = ComputeVertexNormals(truth);
    for (std::size_t p = 0; p < scene.rest.size(); ++p) {
      if (scene.visible[p] == 0) continue;
      correspondences_.push_back(
          {static_cast<int>(p), /*detail=*/-1, scene.truth[p], normals[p], 1.0});
    }
    Add("rotation", 1.0);
    Add("regularization", 10.0);
    Add(data_energy, 100.0);
  }

  const ProblemBuilder& builder() const { return builder_; }
  double Energy(const DeformationState& state) const { return builder_.Evaluate(state).Total(); }

  // From rest, to well beyond the digits that are compared.
  SceneResult Solve(const StrategyOptions& strategy) const {
    return Solve(strategy, DeformationState(scene_.graph.graph.num_nodes()));
  }

  SceneResult Solve(const StrategyOptions& strategy, DeformationState state) const {
    SolverOptions options;
    options.max_iterations = 200;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    const SolveSummary summary = MakeStrategy(strategy)->Solve(builder_, options, &state);
    SceneResult result = Measure(state);
    result.energy = summary.final_energy;
    result.summary = summary;
    return result;
  }

  // Everything but energy and summary.
  SceneResult Measure(const DeformationState& state) const {
    SceneResult result;
    result.state = state;
    WarpPoints(
        scene_.graph.graph, state, scene_.graph.skinning, scene_.rest.points, 1, &result.points);
    double squares[2] = {0.0, 0.0};
    int counts[2] = {0, 0};
    for (std::size_t p = 0; p < result.points.size(); ++p) {
      const int seen = scene_.visible[p] != 0;
      squares[seen] += (result.points[p] - scene_.truth[p]).squaredNorm();
      ++counts[seen];
    }
    result.visible_rms = std::sqrt(squares[1] / counts[1]);
    result.hidden_rms = std::sqrt(squares[0] / counts[0]);
    return result;
  }

 private:
  void Add(const std::string& name, double weight) {
    const auto energy = registry_.Create(name, {});
    EnergyContext context;
    context.graph = &scene_.graph.graph;
    context.points = &scene_.rest.points;
    context.skinning = &scene_.graph.skinning;
    context.correspondences = &correspondences_;
    context.landmarks = &no_landmarks_;
    const int term = builder_.AddTerm(name, (*energy)->kind(), weight);
    builder_.CollectResiduals(term, **energy, context);
  }

  const RegressionScene& scene_;
  EnergyRegistry registry_ = BuiltinEnergies();
  std::vector<Correspondence> correspondences_;
  std::vector<Correspondence> no_landmarks_;
  ProblemBuilder builder_;
};

inline StrategyOptions BatchOptions() { return StrategyOptions(); }

inline StrategyOptions TwoLevelOptions(BoundaryEdges boundary_edges, int rings) {
  StrategyOptions options;
  options.mode = SolveMode::kTwoLevel;
  options.boundary_edges = boundary_edges;
  options.rings = rings;
  return options;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_REGRESSION_TWO_LEVEL_SCENES_H_
