#include <ceres_ed/statistics/shape_model.h>

#include <vector>

#include <gtest/gtest.h>
#include <test/statistics/shape_family.h>

namespace ceres_ed {
namespace {

constexpr int kShapes = 30;
constexpr int kVertices = 50;
const std::vector<double> kVariances = {9.0, 4.0, 1.0};

struct Family {
  Eigen::VectorXd mean = RandomModes(3 * kVertices, 1, 1).col(0) * 20.0;
  Eigen::MatrixXd modes = RandomModes(3 * kVertices, 3, 2);
  Eigen::MatrixXd scores = ExactScores(kShapes, kVariances);
  ShapesInMemory table{(scores * modes.transpose()).rowwise() + mean.transpose()};
};

void ExpectModel(const Family& family, const ShapeModel& model) {
  ASSERT_EQ(model.variances.size(), 3);
  EXPECT_NEAR((model.mean - family.mean).norm(), 0.0, 1e-12);
  EXPECT_NEAR(model.total_variance, 14.0, 1e-9);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(model.variances[k], kVariances[k], 1e-8);
    EXPECT_NEAR(std::abs(model.components.col(k).dot(family.modes.col(k))), 1.0, 1e-9);
  }
  const Eigen::MatrixXd rebuilt = model.scores * model.components.transpose();
  EXPECT_LT((rebuilt - family.scores * family.modes.transpose()).norm(), 1e-6);
}

TEST(ShapeModel, FindsTheModesOfAPopulationWithTheirVariances) {
  const Family family;
  const StatusOr<ShapeModel> model = FitShapeModel(family.table, 10);
  ASSERT_TRUE(model.ok());
  ExpectModel(family, *model);
}

TEST(ShapeModel, PassesFindWhatTheGramMatrixFinds) {
  const Family family;
  const StatusOr<ShapeModel> model = FitShapeModelByPasses(family.table, 10);
  ASSERT_TRUE(model.ok());
  ExpectModel(family, *model);
}

TEST(ShapeModel, VarianceOfVerticesSumsToTheTotal) {
  const Family family;
  const StatusOr<ShapeModel> model = FitShapeModel(family.table, 2);
  ASSERT_TRUE(model.ok());
  double sum = 0.0;
  for (int v = 0; v < kVertices; ++v) {
    double expected = 0.0;
    for (int k = 0; k < 3; ++k) {
      expected += kVariances[k] * family.modes.col(k).segment<3>(3 * v).squaredNorm();
    }
    EXPECT_NEAR(model->vertex_variances[v], expected, 1e-9);
    sum += model->vertex_variances[v];
  }
  EXPECT_NEAR(sum, model->total_variance, 1e-9);
  EXPECT_NEAR(model->ExplainedShares().sum(), 13.0 / 14.0, 1e-9);
}

TEST(ShapeModel, HasNoComponentsWhereNothingVaries) {
  ShapesInMemory::Matrix rows(4, 6);
  rows.setConstant(2.0);
  const StatusOr<ShapeModel> model = FitShapeModel(ShapesInMemory(rows), 3);
  ASSERT_TRUE(model.ok());
  EXPECT_EQ(model->variances.size(), 0);
  EXPECT_EQ(model->components.cols(), 0);
}

}  // namespace
}  // namespace ceres_ed
