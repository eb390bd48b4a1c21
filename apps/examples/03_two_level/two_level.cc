// Compares a batch fit with a two-level fit: a camera sees less than half of a heart.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/pairs.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace ceres_ed;  // NOLINT(google-build-using-namespace): a program, not a header

namespace {

// Returns the mean distance to the truth in percent of the target's diagonal.
double ErrorPercent(const FitResult& fit, const SyntheticPair& pair) {
  PointCloud fitted;
  fitted.points = fit.points;
  return 100.0 * Summarize(PointDistances(fitted, pair.truth)).mean / Diagonal(pair.target.points);
}

FitResult FitPair(const SyntheticPair& pair, SolveMode mode) {
  const EnergyRegistry registry = BuiltinEnergies();
  FitInput input;
  input.source = pair.source;
  input.target = pair.target;
  FitOptions options;
  options.strategy.mode = mode;
  const StatusOr<FitResult> fit = Fit(input, options, registry);
  CHECK(fit.ok()) << fit.status().message();
  CHECK(fit->IsUsable()) << fit->message;
  return *fit;
}

void Print(const char* name, const FitResult& fit, double error) {
  const auto pr = std::count(fit.point_relevant.begin(), fit.point_relevant.end(), 1);
  std::printf(
      "%-10s %d nodes, %d of them seen; solve %.2f s (level I %.2f, level II %.2f); "
      "error %.3f %%\n",
      name,
      fit.warp.graph.num_nodes(),
      static_cast<int>(pr),
      fit.times.solve,
      fit.times.level1,
      fit.times.level2,
      error);
}

}  // namespace

int main() {
  const SyntheticPair pair = MakeSyntheticPair("heart_partial");
  const FitResult batch = FitPair(pair, SolveMode::kBatch);
  const FitResult two_level = FitPair(pair, SolveMode::kTwoLevel);
  const double batch_error = ErrorPercent(batch, pair);
  const double two_level_error = ErrorPercent(two_level, pair);
  Print("batch", batch, batch_error);
  Print("two_level", two_level, two_level_error);
  // Without any fit the error would be 5.7 %.
  return two_level_error < 2.9 && std::abs(two_level_error - batch_error) < 0.1 ? 0 : 1;
}
