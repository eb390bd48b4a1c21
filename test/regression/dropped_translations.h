// Gauss-Newton in dense algebra, with the Jacobian of E_reg by t_k dropped.
#ifndef CERES_ED_TEST_REGRESSION_DROPPED_TRANSLATIONS_H_
#define CERES_ED_TEST_REGRESSION_DROPPED_TRANSLATIONS_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ceres/manifold.h>
#include <glog/logging.h>

namespace ceres_ed {

// Where the columns of t_k, the translation of the node that an edge (j, k) enters, become zero.
enum class Dropped {
  kNowhere,
  // On edges between a PR and a PI node.
  kAtBoundary,
  kEverywhere,
};

using EdgePredicate = std::function<bool(const GraphEdge&)>;

// The graph with those edges alone that `stays` says.
inline DeformationGraph KeepEdges(const DeformationGraph& graph, const EdgePredicate& stays) {
  DeformationGraph kept;
  for (const Eigen::Vector3d& g : graph.positions()) kept.AddNode(g);
  for (const GraphEdge& edge : graph.edges()) {
    if (stays(edge)) kept.AddEdge(edge);
  }
  return kept;
}

// What is left of E_reg to either level where the boundary's columns of t_k are dropped: an edge
// belongs to the node that it leaves.
inline DeformationGraph WithoutEdgesFromHidden(const DeformationGraph& graph,
                                               const std::vector<char>& relevant) {
  return KeepEdges(graph, [&](const GraphEdge& e) { return relevant[e.from] || !relevant[e.to]; });
}
inline DeformationGraph WithoutEdgesFromSeen(const DeformationGraph& graph,
                                             const std::vector<char>& relevant) {
  return KeepEdges(graph, [&](const GraphEdge& e) { return !relevant[e.from] || relevant[e.to]; });
}

// Minimises the problem of `config` to the last digits, or takes one Gauss-Newton step.
inline DeformationState SolveLevel(const ProblemBuilder& builder,
                                   const ProblemConfig& config,
                                   int max_iterations,
                                   DeformationState state) {
  SolverOptions options;
  options.max_iterations = max_iterations;
  options.function_tolerance = 0.0;
  options.parameter_tolerance = 1e-12;
  // Next to no damping.
  options.initial_trust_region_radius = 1e14;
  SolveSummary summary;
  CHECK(MakeLevelSolver(LinearSolver::kBlock)->Solve(builder, config, options, &state, &summary))
      << summary.message;
  return state;
}

// A band of 3 x `columns` nodes with eight neighbours each, of which a camera sees the left part,
// waved and moved; Eq. 3 with the weights of Sumner et al. (2007), and a pose prior, which settles
// the gauge.
inline TestProblem MakeBand(int columns, int observed_columns) {
  TestProblemOptions options;
  options.columns = columns;
  options.points_per_cell = 3;
  options.observed_columns = observed_columns;
  options.has_camera = true;
  TestProblem problem = MakeTestProblem(options);
  const auto join = [&problem](int a, int b) {
    problem.graph.AddEdge({a, b, 1.0});
    problem.graph.AddEdge({b, a, 1.0});
  };
  for (int c = 0; c + 1 < columns; ++c) {
    for (int r = 0; r + 1 < options.rows; ++r) {
      const int corner = c * options.rows + r;
      join(corner, corner + options.rows + 1);
      join(corner + 1, corner + options.rows);
    }
  }
  for (Correspondence& c : problem.correspondences) {
    const Eigen::Vector3d& p = problem.points[c.point];
    c.target = p + Eigen::Vector3d(0.03 * p.y(), 0.05, 0.1 * std::sin(0.8 * p.x()));
  }
  CameraPose motion;
  motion.rotation = Eigen::AngleAxisd(0.05, Eigen::Vector3d(1.0, -1.0, 2.0).normalized());
  motion.translation = {0.2, -0.1, 0.15};
  problem.MoveTargets(motion);
  return problem;
}

// The residuals r of the full problem of a band and their Jacobian, weights included.
struct DenseResiduals {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residuals;
};

// A band's problem. Unknowns are 12 a node, then 6 of the camera.
class Band {
 public:
  explicit Band(TestProblem problem)
      : problem_(std::move(problem)), builder_(problem_.graph, problem_.has_camera) {
    Add("rotation", 1.0);
    regularization_ = Add("regularization", 10.0);
    Add("point_to_point", 100.0);
    Add("pose_prior", 1.0, {{"rotation_sigma", 2.0}, {"translation_sigma", 0.05}});
  }
  Band(const Band&) = delete;
  Band& operator=(const Band&) = delete;

  // The problem on other edges between the same nodes.
  TestProblem OnGraph(const DeformationGraph& graph) const {
    TestProblem other = problem_;
    other.graph = graph;
    return other;
  }

  const TestProblem& problem() const { return problem_; }
  const DeformationGraph& graph() const { return problem_.graph; }
  const ProblemBuilder& builder() const { return builder_; }
  int num_nodes() const { return problem_.graph.num_nodes(); }
  int camera_offset() const { return kNodeSize * num_nodes(); }
  ProblemConfig Full() const { return FullConfig(num_nodes(), true); }
  ProblemConfig LevelOne(BoundaryEdges boundary_edges) const {
    return LevelOneConfig(graph(), PointRelevant(), true, boundary_edges, 0);
  }
  ProblemConfig LevelTwo() const { return LevelTwoConfig(PointRelevant()); }
  std::vector<char> PointRelevant() const { return builder_.PointRelevantNodes(); }
  double Energy(const DeformationState& state) const { return builder_.Evaluate(state).Total(); }

  DeformationState Plus(DeformationState state, const Eigen::VectorXd& delta) const {
    NormalEquations(builder_, Full()).Plus(delta, &state);
    return state;
  }

  DenseResiduals Linearize(const DeformationState& state, Dropped dropped) const {
    const std::vector<SelectedResidual> selected = builder_.Select(Full());
    int rows = 0;
    for (const SelectedResidual& residual : selected) rows += residual.num_residuals();
    DenseResiduals dense;
    dense.jacobian.setZero(rows, camera_offset() + 6);
    dense.residuals.setZero(rows);
    int row = 0;
    for (const SelectedResidual& residual : selected) {
      AddRows(state, residual, Drops(dropped, residual), row, &dense);
      row += residual.num_residuals();
    }
    return dense;
  }

 private:
  int Add(const std::string& name,
          double weight,
          const std::map<std::string, double>& parameters = {}) {
    const auto energy = registry_.Create(name, parameters);
    CHECK(energy.ok()) << energy.status().message();
    const int term = builder_.AddTerm(name, (*energy)->kind(), weight);
    builder_.CollectResiduals(term, **energy, problem_.Context());
    return term;
  }

  bool Drops(Dropped dropped, const SelectedResidual& residual) const {
    if (residual.term != regularization_ || dropped == Dropped::kNowhere) return false;
    if (dropped == Dropped::kEverywhere) return true;
    const std::vector<char> relevant = PointRelevant();
    return relevant[residual.blocks[0].node] != relevant[residual.blocks[1].node];
  }

  void AddRows(const DeformationState& state,
               const SelectedResidual& residual,
               bool drops,
               int row,
               DenseResiduals* dense) const {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto cost = residual.CostFunction(graph());
    const int rows = residual.num_residuals();
    std::vector<const double*> blocks;
    std::vector<RowMajor> parts;
    std::vector<double*> jacobians;
    for (int b = 0; b < residual.num_blocks; ++b) {
      blocks.push_back(BlockPointer(state, residual.blocks[b]));
      parts.emplace_back(rows, cost->parameter_block_sizes()[b]);
    }
    for (RowMajor& part : parts) jacobians.push_back(part.data());
    double* values = dense->residuals.data() + row;
    CHECK(cost->Evaluate(blocks.data(), values, jacobians.data()));
    const double scale = std::sqrt(residual.weight);
    dense->residuals.segment(row, rows) *= scale;
    // Blocks are node j, node k.
    if (drops) parts[1].rightCols(3).setZero();
    for (int b = 0; b < residual.num_blocks; ++b) {
      Eigen::MatrixXd part = scale * parts[b];
      int column = camera_offset() + 3;
      if (residual.blocks[b].kind == BlockRef::Kind::kNode) {
        column = kNodeSize * residual.blocks[b].node;
      } else if (residual.blocks[b].kind == BlockRef::Kind::kCameraRotation) {
        Eigen::Matrix<double, 4, 3, Eigen::RowMajor> plus;
        CHECK(ceres::EigenQuaternionManifold().PlusJacobian(blocks[b], plus.data()));
        part = part * plus;
        column = camera_offset();
      }
      dense->jacobian.block(row, column, rows, part.cols()) += part;
    }
  }

  TestProblem problem_;
  EnergyRegistry registry_ = BuiltinEnergies();
  ProblemBuilder builder_;
  int regularization_ = -1;
};

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_REGRESSION_DROPPED_TRANSLATIONS_H_
