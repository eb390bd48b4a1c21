#include "small_fit.h"

#include <ceres_ed/report/view/fit_view.h>
#include <ceres_ed/report/view/view_camera.h>

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(FitView, ShowsSourceTargetAndResultInOneFrame) {
  const SmallFit fit = MakeSmallFit();
  const FitView view = MakeFitView(fit.Parts());
  ASSERT_EQ(view.scene.panels.size(), 3U);
  EXPECT_EQ(view.scene.panels[0].title, "Source");
  EXPECT_EQ(view.scene.panels[1].title, "Target");
  EXPECT_EQ(view.scene.panels[2].title, "Result");
  EXPECT_LT(view.scene.panels[2].at, 0.0) << "the slider moves it";
  const std::vector<Eigen::Vector3d> end = PointsAt(view.scene.surfaces[0], 1.0);
  for (std::size_t i = 0; i < end.size(); ++i) EXPECT_LT((end[i] - fit.result[i]).norm(), 1e-12);
  EXPECT_TRUE(view.scene.notes.empty());
}

TEST(FitView, MeasuresTheErrorsThatAreKnown) {
  const SmallFit fit = MakeSmallFit();
  const FitView view = MakeFitView(fit.Parts());
  const ScalarField* const truth = view.scene.surfaces[0].Find("truth");
  ASSERT_NE(truth, nullptr);
  for (const double error : truth->values) EXPECT_NEAR(error, 0.02, 1e-12);
  // The target lies 0.01 above the result.
  for (const double distance : view.distances.to_target) EXPECT_LE(distance, 0.01 + 1e-12);
  const ScalarField* const displacement = view.scene.surfaces[0].Find("displacement");
  ASSERT_NE(displacement, nullptr);
  EXPECT_NEAR(displacement->values[3], (fit.result[3] - fit.source.points[3]).norm(), 1e-12);
  const ScalarField* const bend = view.scene.surfaces[0].Find("bend");
  ASSERT_NE(bend, nullptr);
  EXPECT_NEAR(bend->values[3],
              (fit.result[3] - fit.warp.target_from_source * fit.source.points[3]).norm(),
              1e-12);
  EXPECT_EQ(view.scene.first_field, "truth");
}

TEST(FitView, BothSurfacesHaveOneRangeOfDistances) {
  const FitView view = MakeFitView(MakeSmallFit().Parts());
  const FieldRange& one = view.scene.surfaces[0].Find("distance")->range;
  const FieldRange& other = view.scene.surfaces[1].Find("distance")->range;
  EXPECT_EQ(one.high, other.high);
  EXPECT_EQ(one.max, other.max);
}

TEST(FitView, TheGraphHasEachEdgeOnceAndKnowsPrAndPi) {
  const SmallFit fit = MakeSmallFit();
  const FitView view = MakeFitView(fit.Parts());
  EXPECT_EQ(view.scene.graph.edges.size(), 4U) << "4 -> 0 is 0 -> 4";
  ASSERT_EQ(view.scene.graph.kinds.size(), 5U);
  EXPECT_EQ(view.scene.graph.kinds[0], NodeKind::kPr);
  EXPECT_EQ(view.scene.graph.kinds[1], NodeKind::kPi);
}

TEST(FitView, AWarpOfAnotherFitIsNotFollowed) {
  SmallFit fit = MakeSmallFit();
  for (Eigen::Vector3d& point : fit.result) point.y() += 0.5;
  const FitView view = MakeFitView(fit.Parts());
  ASSERT_EQ(view.scene.notes.size(), 1U);
  EXPECT_NE(view.scene.notes[0].find("straight lines"), std::string::npos);
  const std::vector<Eigen::Vector3d> end = PointsAt(view.scene.surfaces[0], 1.0);
  EXPECT_LT((end[5] - fit.result[5]).norm(), 1e-12);
}

TEST(FitView, LandmarksStayWhenPointsAreLeftOut) {
  SmallFit fit = MakeSmallFit();
  FitParts parts = fit.Parts();
  parts.max_points = 20;
  const Eigen::Vector3d wanted = fit.result[17] + Eigen::Vector3d(0.0, 0.0, 0.3);
  parts.landmarks = {{"apex", {17, wanted}}};
  const FitView view = MakeFitView(parts);
  const ViewSurface& source = view.scene.surfaces[0];
  EXPECT_TRUE(source.IsDecimated());
  EXPECT_EQ(source.all_points, 144);
  ASSERT_EQ(view.scene.landmarks.size(), 1U);
  const ViewLandmark& landmark = view.scene.landmarks[0];
  EXPECT_EQ(landmark.name, "apex");
  EXPECT_EQ(source.rows[landmark.point], 17);
  EXPECT_NEAR(landmark.error, 0.3, 1e-12);
  EXPECT_EQ(view.distances.to_target.size(), 144U) << "figures are of all points";
}

TEST(FitView, UnknownDeviationsHaveNoColour) {
  const SmallFit fit = MakeSmallFit();
  FitParts parts = fit.Parts();
  parts.std_dev.assign(fit.source.size(), 0.5);
  parts.std_dev[3] = -1.0;
  const FitView view = MakeFitView(parts);
  const ScalarField* const field = view.scene.surfaces[0].Find("std_dev");
  ASSERT_NE(field, nullptr);
  EXPECT_TRUE(std::isnan(field->values[3]));
  EXPECT_EQ(field->range.min, 0.5);
}

TEST(FitView, AResultAloneIsEnough) {
  const SmallFit fit = MakeSmallFit();
  FitParts parts;
  parts.result = &fit.result;
  const FitView view = MakeFitView(parts);
  ASSERT_EQ(view.scene.panels.size(), 1U);
  EXPECT_TRUE(view.scene.surfaces[0].fields.empty());
  EXPECT_TRUE(view.distances.to_target.empty());
}

TEST(MeanEdgeStretch, IsThePercentageOfASurfaceThatGrows) {
  const PointCloud square = SquareCloud(4);
  std::vector<Eigen::Vector3d> after = square.points;
  for (Eigen::Vector3d& point : after) point *= 1.1;
  for (const double stretch : MeanEdgeStretch(square.points, after, square.triangles)) {
    EXPECT_NEAR(stretch, 10.0, 1e-9);
  }
  EXPECT_TRUE(std::isnan(MeanEdgeStretch(square.points, after, {})[0]));
}

TEST(ViewCamera, LooksAtTheSideThatATargetShows) {
  Scene scene;
  std::vector<int> kept;
  // The triangles of the square face +z.
  scene.surfaces.push_back(MakeViewSurface("target", SquareCloud(4), {}, 1000, {}, &kept));
  scene.panels.push_back({"Target", 0, 1.0, false, true});
  const ViewCamera camera = ChooseCamera(scene);
  EXPECT_NEAR(camera.from.z(), std::cos(50.0 * M_PI / 180.0), 1e-12);
  EXPECT_NEAR(camera.from.norm(), 1.0, 1e-12);
  EXPECT_EQ(camera.from.y(), 0.0);
}

TEST(SceneBall, HoldsBothEndsOfTheWay) {
  const SmallFit fit = MakeSmallFit();
  const FitView view = MakeFitView(fit.Parts());
  const SceneBall ball = BallAround(view.scene);
  for (const std::vector<Eigen::Vector3d>* const points : {&fit.source.points, &fit.result}) {
    for (const Eigen::Vector3d& point : *points) {
      EXPECT_LE((point - ball.center).norm(), ball.radius + 1e-12);
    }
  }
  EXPECT_EQ(BallAround(Scene()).radius, 1.0);
}

}  // namespace
}  // namespace ceres_ed
