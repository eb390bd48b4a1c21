#include "ceres_ed/testing/test_problem.h"

#include <ceres_ed/util/random.h>

#include <array>
#include <cmath>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// A height that keeps the nodes and points from lying in one plane.
double Height(double x, double y) { return 0.3 * std::sin(0.9 * x + 0.5 * y); }

Eigen::Vector3d GaussianVector(double deviation, Random* random) {
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) vector[i] = deviation * random->Gaussian();
  return vector;
}

void AddNodes(const TestProblemOptions& options, DeformationGraph* graph) {
  for (int c = 0; c < options.columns; ++c) {
    for (int r = 0; r < options.rows; ++r) graph->AddNode({1.0 * c, 1.0 * r, Height(c, r)});
  }
  const auto join = [graph](int a, int b) {
    graph->AddEdge({a, b, 1.0});
    graph->AddEdge({b, a, 1.0});
  };
  for (int c = 0; c < options.columns; ++c) {
    for (int r = 0; r < options.rows; ++r) {
      const int node = c * options.rows + r;
      if (c + 1 < options.columns) join(node, node + options.rows);
      if (r + 1 < options.rows) join(node, node + 1);
    }
  }
}

// Adds a point with bilinear weights. All four are positive inside the cell, and their sum is 1.
void AddPoint(int column, int row, double u, double v, int rows, TestProblem* problem) {
  const double x = column + u;
  const double y = row + v;
  problem->points.emplace_back(x, y, Height(x, y) + 0.05);
  const int corner = column * rows + row;
  const std::array<int, 4> nodes{corner, corner + rows, corner + 1, corner + rows + 1};
  const std::array<double, 4> weights{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  problem->skinning.Add(nodes.data(), weights.data(), 4);
}

// Adds the details. They use a random generator of their own, so that the correspondences are the
// same with and without details.
void AddDetails(std::uint64_t seed, TestProblem* problem) {
  Random random(seed + 1);
  for (Correspondence& c : problem->correspondences) {
    MatchDetail detail;
    detail.source_normal = (Eigen::Vector3d::UnitZ() + GaussianVector(0.3, &random)).normalized();
    detail.target_normal = c.normal;
    detail.target_intensity = random.Uniform();
    detail.source_intensity = detail.target_intensity;
    const Eigen::Vector3d slope = GaussianVector(0.5, &random);
    detail.intensity_gradient = slope - c.normal * c.normal.dot(slope);
    c.detail = static_cast<int>(problem->match_details.size());
    problem->match_details.push_back(detail);
  }
}

}  // namespace

EnergyContext TestProblem::Context() const {
  EnergyContext context;
  context.graph = &graph;
  context.points = &points;
  context.skinning = &skinning;
  context.correspondences = &correspondences;
  context.match_details = &match_details;
  context.landmarks = &landmarks;
  context.has_camera = has_camera;
  context.camera_prior = camera_prior;
  context.node_prior = &node_prior;
  context.node_previous = &node_prior;
  return context;
}

void TestProblem::MoveTargets(const CameraPose& motion) {
  for (std::vector<Correspondence>* list : {&correspondences, &landmarks}) {
    for (Correspondence& c : *list) {
      c.target = motion * c.target;
      c.normal = motion.rotation * c.normal;
    }
  }
  for (MatchDetail& detail : match_details) {
    detail.source_normal = motion.rotation * detail.source_normal;
    detail.target_normal = motion.rotation * detail.target_normal;
    detail.intensity_gradient = motion.rotation * detail.intensity_gradient;
  }
}

TestProblem MakeTestProblem(const TestProblemOptions& options) {
  CHECK(options.columns >= 2 && options.rows >= 2 && options.points_per_cell >= 1);
  TestProblem problem;
  problem.has_camera = options.has_camera;
  AddNodes(options, &problem.graph);
  problem.node_prior.assign(problem.graph.num_nodes(), Eigen::Vector3d::Zero());
  Random random(options.seed);
  const int observed =
      options.observed_columns < 0 ? options.columns - 1 : options.observed_columns;
  const auto observe = [&](int point) {
    Correspondence c;
    c.point = point;
    c.target = problem.points[point] + GaussianVector(options.target_deviation, &random);
    c.normal = (Eigen::Vector3d::UnitZ() + GaussianVector(0.3, &random)).normalized();
    return c;
  };
  for (int column = 0; column + 1 < options.columns; ++column) {
    for (int row = 0; row + 1 < options.rows; ++row) {
      for (int i = 0; i < options.points_per_cell; ++i) {
        const double u = 0.1 + 0.8 * random.Uniform();
        const double v = 0.1 + 0.8 * random.Uniform();
        AddPoint(column, row, u, v, options.rows, &problem);
        const int point = static_cast<int>(problem.points.size()) - 1;
        if (column < observed) problem.correspondences.push_back(observe(point));
      }
    }
  }
  AddDetails(options.seed, &problem);
  problem.landmarks = {observe(0), observe(static_cast<int>(problem.points.size()) - 1)};
  return problem;
}

DeformationState RandomState(const TestProblem& problem, double deviation, std::uint64_t seed) {
  Random random(seed);
  DeformationState state(problem.graph.num_nodes());
  for (int j = 0; j < state.num_nodes(); ++j) {
    for (int i = 0; i < kNodeSize; ++i) state.node(j)[i] += deviation * random.Gaussian();
  }
  if (!problem.has_camera) return state;
  CameraPose& camera = state.camera_from_map;
  camera.translation = GaussianVector(deviation, &random);
  for (int i = 0; i < kRotationSize; ++i) {
    camera.rotation.coeffs()[i] += deviation * random.Gaussian();
  }
  camera.rotation.normalize();
  return state;
}

DeformationState RigidState(const DeformationGraph& graph, const CameraPose& motion) {
  DeformationState state(graph.num_nodes());
  for (int j = 0; j < graph.num_nodes(); ++j) {
    MutableNodeAffine(state.node(j)) = motion.rotation.toRotationMatrix();
    MutableNodeTranslation(state.node(j)) = motion * graph.position(j) - graph.position(j);
  }
  return state;
}

}  // namespace ceres_ed
