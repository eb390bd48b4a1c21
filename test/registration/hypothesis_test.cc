#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/registration/hypotheses/hypothesis.h>
#include <ceres_ed/simulation/pairs.h>

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

}  // namespace
}  // namespace ceres_ed
