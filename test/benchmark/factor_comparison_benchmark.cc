// The multifrontal factor of this library, CHOLMOD (supernodal, with the BLAS of this build) and
// Eigen's SimplicialLDLT on the same normal matrices:
//   Fit: all nodes of a closed body, a point in each cell of four nodes.
//   Level: Level I of a window, 300 of 400 nodes seen, and a camera.
//   Constraints: a sheet on which few points are given. The library's solver gives these points
//     dual unknowns, which the others can't factorise; they get the matrix without them.
// The time is that of one factorisation with the pattern known and the memory of an earlier one, as
// in the steps of a minimisation. Counters: milliseconds of ordering
// and analysis, of one solve (both CPU time, which other work on the machine does not change much),
// the megabytes of the factor, and the rows of the matrix.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/linear_algebra/linear_algebra_backend.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <ctime>
#include <memory>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <benchmark/benchmark.h>
#include <cholmod.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Levenberg and Marquardt's damping of the first step.
constexpr double kDamping = 1e-4;

struct Problem {
  int columns = 0;
  int rows = 0;
  int observed_columns = -1;
  int points_per_cell = 1;
  bool has_camera = false;
};
constexpr Problem kFit{60, 60, -1, 2, false};
constexpr Problem kLargeFit{150, 150, -1, 2, false};
constexpr Problem kLevel{20, 20, 14, 30, true};
constexpr Problem kConstraints{141, 141, 10, 1, false};

// The damped normal matrix of a problem at rest.
struct NormalMatrix {
  NormalMatrix(const Problem& problem, DualResiduals dual) {
    TestProblemOptions options;
    options.columns = problem.columns;
    options.rows = problem.rows;
    options.observed_columns = problem.observed_columns;
    options.points_per_cell = problem.points_per_cell;
    options.has_camera = problem.has_camera;
    options.target_deviation = 0.1;
    test = MakeTestProblem(options);
    builder = std::make_unique<ProblemBuilder>(test.graph, problem.has_camera);
    const EnergyRegistry registry = BuiltinEnergies();
    const auto add = [&](const char* name, double weight) {
      const auto term = registry.Create(name, {});
      CHECK(term.ok());
      const int index = builder->AddTerm(name, (*term)->kind(), weight, {});
      builder->CollectResiduals(index, **term, test.Context());
    };
    add("rotation", 1.0);
    add("regularization", 10.0);
    add("point_to_plane", 1.0);
    if (problem.has_camera) add("pose_prior", 0.1);
    ProblemConfig config;
    config.variable_nodes.assign(test.graph.num_nodes(), 1);
    config.camera_variable = problem.has_camera;
    equations.Build(*builder, config, dual);
    structure = std::make_unique<BlockStructure>(
        equations.BlockSizes(), equations.BlockPairs(), equations.num_dual());
    CHECK(equations.SetStructure(structure.get()));
    double cost = 0.0;
    Eigen::VectorXd gradient;
    CHECK(
        equations.Evaluate(DeformationState(test.graph.num_nodes()), 1, &cost, &values, &gradient));
    diagonal = kDamping * structure->Diagonal(values);
    diagonal.tail(structure->num_rows() - structure->num_primal_rows()).setZero();
    rhs = -gradient;
  }

  // Returns the lower triangle, entry by entry, without those that are zero.
  Eigen::SparseMatrix<double> Lower() const {
    std::vector<Eigen::Triplet<double>> triplets;
    for (int column = 0; column < structure->num_blocks(); ++column) {
      for (int e = structure->column_begin(column); e < structure->column_begin(column + 1); ++e) {
        const int row = structure->entry_row(e);
        const Eigen::Map<const Eigen::MatrixXd> block(
            &values[structure->value_offset(e)], structure->size(row), structure->size(column));
        for (int c = 0; c < block.cols(); ++c) {
          for (int r = row == column ? c : 0; r < block.rows(); ++r) {
            if (block(r, c) == 0.0 && !(row == column && r == c)) continue;
            triplets.emplace_back(
                structure->row_offset(row) + r, structure->row_offset(column) + c, block(r, c));
          }
        }
      }
    }
    Eigen::SparseMatrix<double> lower(structure->num_rows(), structure->num_rows());
    lower.setFromTriplets(triplets.begin(), triplets.end());
    for (int i = 0; i < lower.cols(); ++i) lower.coeffRef(i, i) += diagonal[i];
    lower.makeCompressed();
    return lower;
  }

  TestProblem test;
  std::unique_ptr<ProblemBuilder> builder;
  NormalEquations equations;
  std::unique_ptr<BlockStructure> structure;
  std::vector<double> values;
  Eigen::VectorXd diagonal;
  Eigen::VectorXd rhs;
};

// Measures the CPU time of the process.
class CpuTimer {
 public:
  double Seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }
  void Restart() { start_ = std::clock(); }

 private:
  std::clock_t start_ = std::clock();
};

void SetCounters(double analysis_s, double solve_s, double megabytes, benchmark::State* state) {
  state->counters["analysis_ms"] = 1e3 * analysis_s;
  state->counters["solve_ms"] = 1e3 * solve_s;
  state->counters["factor_MB"] = megabytes;
}

void Multifrontal(benchmark::State& state, const Problem& problem) {
  const NormalMatrix matrix(problem, DualResiduals::kWhereTheyPay);
  CpuTimer timer;
  BlockCholesky cholesky(*matrix.structure);
  const double analysis_s = timer.Seconds();
  CHECK(cholesky.Factorize(matrix.values.data(), matrix.diagonal, state.range(0)));
  for (auto _ : state) {
    CHECK(cholesky.Factorize(matrix.values.data(), matrix.diagonal, state.range(0)));
  }
  timer.Restart();
  benchmark::DoNotOptimize(cholesky.Solve(matrix.rhs));
  SetCounters(analysis_s, timer.Seconds(), 8e-6 * cholesky.NumValues(), &state);
  state.counters["rows"] = matrix.structure->num_primal_rows();
  state.counters["dual_rows"] = matrix.structure->num_rows() - matrix.structure->num_primal_rows();
}

void Cholmod(benchmark::State& state, const Problem& problem) {
  const NormalMatrix matrix(problem, DualResiduals::kNever);
  Eigen::SparseMatrix<double> lower = matrix.Lower();
  // With two threads, OpenBLAS and OpenMP have those that they take by themselves.
  const std::unique_ptr<ScopedSerialLinearAlgebra> serial =
      state.range(0) == 1 ? std::make_unique<ScopedSerialLinearAlgebra>() : nullptr;
  cholmod_common common;
  cholmod_start(&common);
  common.supernodal = CHOLMOD_SUPERNODAL;
  cholmod_sparse sparse{};
  sparse.nrow = lower.rows();
  sparse.ncol = lower.cols();
  sparse.nzmax = lower.nonZeros();
  sparse.p = lower.outerIndexPtr();
  sparse.i = lower.innerIndexPtr();
  sparse.x = lower.valuePtr();
  sparse.stype = -1;
  sparse.itype = CHOLMOD_INT;
  sparse.xtype = CHOLMOD_REAL;
  sparse.dtype = CHOLMOD_DOUBLE;
  sparse.sorted = 1;
  sparse.packed = 1;
  CpuTimer timer;
  cholmod_factor* factor = cholmod_analyze(&sparse, &common);
  const double analysis_s = timer.Seconds();
  CHECK(cholmod_factorize(&sparse, factor, &common) != 0);
  for (auto _ : state) {
    CHECK(cholmod_factorize(&sparse, factor, &common) != 0);
    CHECK_EQ(common.status, CHOLMOD_OK);
  }
  cholmod_dense rhs{};
  rhs.nrow = rhs.nzmax = rhs.d = matrix.rhs.size();
  rhs.ncol = 1;
  rhs.x = const_cast<double*>(matrix.rhs.data());
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  timer.Restart();
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor, &rhs, &common);
  const double solve_s = timer.Seconds();
  const Eigen::Map<const Eigen::VectorXd> x(static_cast<double*>(solution->x), matrix.rhs.size());
  const Eigen::VectorXd product = lower.selfadjointView<Eigen::Lower>() * x;
  CHECK_LT((product - matrix.rhs).norm(), 1e-6 * matrix.rhs.norm());
  SetCounters(analysis_s, solve_s, 8e-6 * factor->xsize, &state);
  cholmod_free_dense(&solution, &common);
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
}

void EigenLdlt(benchmark::State& state, const Problem& problem) {
  const NormalMatrix matrix(problem, DualResiduals::kNever);
  const Eigen::SparseMatrix<double> lower = matrix.Lower();
  CpuTimer timer;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  factor.analyzePattern(lower);
  const double analysis_s = timer.Seconds();
  factor.factorize(lower);
  for (auto _ : state) {
    factor.factorize(lower);
    CHECK(factor.info() == Eigen::Success);
  }
  timer.Restart();
  benchmark::DoNotOptimize(Eigen::VectorXd(factor.solve(matrix.rhs)));
  SetCounters(
      analysis_s, timer.Seconds(), 8e-6 * factor.matrixL().nestedExpression().nonZeros(), &state);
}

void OneAndTwoThreads(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void OneThread(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(Multifrontal, Fit, kFit)->Apply(OneAndTwoThreads);
BENCHMARK_CAPTURE(Cholmod, Fit, kFit)->Apply(OneAndTwoThreads);
BENCHMARK_CAPTURE(EigenLdlt, Fit, kFit)->Apply(OneThread);
BENCHMARK_CAPTURE(Multifrontal, LargeFit, kLargeFit)->Apply(OneAndTwoThreads);
BENCHMARK_CAPTURE(Cholmod, LargeFit, kLargeFit)->Apply(OneAndTwoThreads);
BENCHMARK_CAPTURE(Multifrontal, Level, kLevel)->Apply(OneAndTwoThreads);
BENCHMARK_CAPTURE(Cholmod, Level, kLevel)->Apply(OneAndTwoThreads);
BENCHMARK_CAPTURE(EigenLdlt, Level, kLevel)->Apply(OneThread);
BENCHMARK_CAPTURE(Multifrontal, Constraints, kConstraints)->Apply(OneAndTwoThreads);
BENCHMARK_CAPTURE(Cholmod, Constraints, kConstraints)->Apply(OneAndTwoThreads);
BENCHMARK_CAPTURE(EigenLdlt, Constraints, kConstraints)->Apply(OneThread);

}  // namespace
}  // namespace ceres_ed
