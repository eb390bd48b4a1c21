#include <ceres_ed/statistics/model_quality.h>
#include <ceres_ed/statistics/shape_model.h>

#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <test/statistics/shape_family.h>

namespace ceres_ed {
namespace {

constexpr int kShapes = 12;
constexpr int kVertices = 20;

ShapesInMemory::Matrix NoisyRows() {
  const Eigen::MatrixXd modes = RandomModes(3 * kVertices, 2, 2);
  ShapesInMemory::Matrix rows = ExactScores(kShapes, {4.0, 1.0}) * modes.transpose();
  Random random(5);
  for (Eigen::Index i = 0; i < rows.size(); ++i) rows.data()[i] += 0.05 * random.Gaussian();
  return rows;
}

// The same by its definition: a model of the others, and a projection on it.
TEST(ModelQuality, GeneralizationIsThatOfModelsWithoutTheShape) {
  const ShapesInMemory::Matrix rows = NoisyRows();
  const StatusOr<ModelQuality> quality = MeasureModelQuality(ShapesInMemory(rows));
  ASSERT_TRUE(quality.ok());
  ASSERT_EQ(quality->generalization.size(), 10u);
  for (const int components : {1, 2, 5}) {
    double mean = 0.0;
    for (int i = 0; i < kShapes; ++i) {
      ShapesInMemory::Matrix others(kShapes - 1, rows.cols());
      others << rows.topRows(i), rows.bottomRows(kShapes - 1 - i);
      const StatusOr<ShapeModel> model = FitShapeModel(ShapesInMemory(others), components);
      ASSERT_TRUE(model.ok());
      Eigen::VectorXd rest = rows.row(i).transpose() - model->mean;
      rest -= model->components * (model->components.transpose() * rest);
      mean += rest.norm() / std::sqrt(kVertices) / kShapes;
    }
    EXPECT_NEAR(quality->generalization[components - 1], mean, 1e-9);
  }
}

TEST(ModelQuality, SpecificityIsTheDistanceOfRandomShapesFromTheNearest) {
  const ShapesInMemory::Matrix rows = NoisyRows();
  const ShapesInMemory table(rows);
  ModelQualityOptions options;
  options.samples = 4000;
  const StatusOr<ModelQuality> quality = MeasureModelQuality(table, options);
  const StatusOr<ShapeModel> model = FitShapeModel(table, 2);
  ASSERT_TRUE(quality.ok() && model.ok());
  Random random(99);
  double mean = 0.0;
  for (int s = 0; s < options.samples; ++s) {
    Eigen::VectorXd shape = model->mean;
    for (int k = 0; k < 2; ++k) {
      shape += std::sqrt(model->variances[k]) * random.Gaussian() * model->components.col(k);
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kShapes; ++i) {
      nearest = std::min(nearest, (rows.row(i).transpose() - shape).norm());
    }
    mean += nearest / std::sqrt(kVertices) / options.samples;
  }
  EXPECT_NEAR(quality->specificity[1], mean, 0.03 * mean);
}

TEST(ModelQuality, MeasuresSomeShapesOfALargePopulation) {
  ModelQualityOptions options;
  options.max_shapes = 6;
  const StatusOr<ModelQuality> quality = MeasureModelQuality(ShapesInMemory(NoisyRows()), options);
  ASSERT_TRUE(quality.ok());
  EXPECT_EQ(quality->shapes, 6);
  EXPECT_EQ(quality->generalization.size(), 4u);
}

TEST(ModelQuality, SaysNothingAboutTwoShapes) {
  const StatusOr<ModelQuality> quality =
      MeasureModelQuality(ShapesInMemory(NoisyRows().topRows(2)));
  ASSERT_TRUE(quality.ok());
  EXPECT_TRUE(quality->generalization.empty());
}

}  // namespace
}  // namespace ceres_ed
