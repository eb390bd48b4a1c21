#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/registration/hypotheses/hypothesis.h>
#include <ceres_ed/simulation/pairs.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

TEST(Hypotheses, AreChosenByTheirNames) {
  FitOptions options;
  std::string error;
  options.hypotheses = "bold,careful";
  EXPECT_TRUE(options.IsValid(&error)) << error;
  options.hypotheses = "bold,bald";
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_NE(error.find("'bald'"), std::string::npos) << error;
  options.hypotheses = "bold,bold";
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_NE(error.find("twice"), std::string::npos) << error;
}

TEST(Hypotheses, NameTheOneThatTheFitWentOnWith) {
  const SyntheticPair pair = MakeSyntheticPair("plane_bumps");
  FitInput input;
  input.source = pair.source;
  input.target = pair.target;
  FitOptions options;
  options.hypotheses = "bold";
  const StatusOr<FitResult> fit = Fit(input, options, BuiltinEnergies());
  ASSERT_TRUE(fit.ok()) << fit.status().message();
  EXPECT_EQ(fit->hypothesis, "bold");
}

TEST(Hypotheses, StartFromTheGivenPoseByARigidMotion) {
  const Surface sheet(MakeGridMesh(30, 30));
  GraphOptions graph_options;
  graph_options.node_spacing = 6.0;
  const StatusOr<BuiltGraph> graph = BuildGraph(sheet.cloud(), sheet.topology(), graph_options);
  ASSERT_TRUE(graph.ok()) << graph.status().message();
  UnitFit fit;
  fit.given_from_placed.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  fit.given_from_placed.translation = Eigen::Vector3d(0.3, -4.0, 2.0);
  Hypothesis hypothesis;
  hypothesis.start = HypothesisStart::kGiven;
  const DeformationState state = StartOf(hypothesis, fit, *graph);
  const std::vector<Eigen::Vector3d>& points = sheet.cloud().points;
  for (std::size_t p = 0; p < points.size(); p += 7) {
    const Eigen::Vector3d warped = WarpPoint(graph->graph, state, graph->skinning[p], points[p]);
    EXPECT_LT((warped - fit.given_from_placed * points[p]).norm(), 1e-12);
  }
  hypothesis.start = HypothesisStart::kPlaced;
  const DeformationState rest = StartOf(hypothesis, fit, *graph);
  EXPECT_EQ(WarpPoint(graph->graph, rest, graph->skinning[5], points[5]), points[5]);
}

// Returns a wavy sheet of about 1 x 0.8; with `bend` it is also bent, by 12 % of its length.
PointCloud MakeWavySheet(int columns, int rows, bool bend) {
  PointCloud sheet = MakeGridMesh(columns, rows);
  for (Eigen::Vector3d& point : sheet.points) {
    const double x = point.x() / (columns - 1.0) - 0.5;
    const double y = 0.8 * (point.y() / (rows - 1.0) - 0.5);
    point = {x, y, 0.04 * std::sin(5.0 * x) * std::cos(4.0 * y)};
    if (bend) point.z() += 0.12 * std::sin(3.0 * x + 2.0) * std::cos(2.0 * y);
  }
  return sheet;
}

// Returns the mean error of a fit of the sheet to the bent one, in percent of its diagonal.
double ErrorOnBentSheet(const std::string& hypotheses) {
  FitInput input;
  input.source = MakeWavySheet(60, 50, /*bend=*/false);
  input.target = MakeWavySheet(55, 47, /*bend=*/true);
  const PointCloud truth = MakeWavySheet(60, 50, /*bend=*/true);
  FitOptions options;
  options.hypotheses = hypotheses;
  const StatusOr<FitResult> fit = Fit(input, options, BuiltinEnergies());
  if (!fit.ok()) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (std::size_t p = 0; p < truth.size(); ++p) {
    sum += (fit->points[p] - truth.points[p]).norm();
  }
  return 100.0 * sum / static_cast<double>(truth.size()) / Diagonal(truth.points);
}

// The bend misleads the rigid stage, which slides the sheet along itself; the given pose does not.
TEST(Hypotheses, GoOnWithTheGivenPoseWhereThatExplainsMore) {
  EXPECT_GT(ErrorOnBentSheet("careful,bold"), 8.0);
  EXPECT_LT(ErrorOnBentSheet(""), 4.0);
}

}  // namespace
}  // namespace ceres_ed
