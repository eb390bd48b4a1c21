#include "ceres_ed/evaluation/covariance_calibration.h"

#include <cmath>
#include <fstream>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

struct Sample {
  std::vector<Eigen::Vector3d> errors;
  std::vector<Eigen::Matrix3d> covariances;
  std::vector<char> is_seen;
};

// Errors drawn from covariances of many sizes and shapes. What is written as the covariance is
// `claimed` times that.
Sample Draw(int size, double claimed) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Sample sample;
  for (int i = 0; i < size; ++i) {
    Eigen::Matrix3d root;
    for (int j = 0; j < 9; ++j) root(j / 3, j % 3) = normal(random);
    root *= std::pow(10.0, 2.0 * uniform(random));
    const Eigen::Vector3d white(normal(random), normal(random), normal(random));
    sample.errors.push_back(root * white);
    sample.covariances.push_back(claimed * root * root.transpose());
    sample.is_seen.push_back(static_cast<char>(i % 3 == 0));
  }
  return sample;
}

TEST(Calibration, CovariancesThatAreRightCoverWhatTheyPromise) {
  const Sample sample = Draw(20000, 1.0);
  const CalibrationFigures figures =
      MeasureCalibration(sample.errors, sample.covariances, sample.is_seen);
  for (const auto& part : {figures.all, figures.seen, figures.hidden}) {
    ASSERT_TRUE(part.has_value());
    // Four standard deviations of a share of 6667 points.
    EXPECT_NEAR(part->coverage_50, 0.50, 0.025);
    EXPECT_NEAR(part->coverage_80, 0.80, 0.020);
    EXPECT_NEAR(part->coverage_95, 0.95, 0.011);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(part->reliability[i], 0.1 * (i + 1), 0.025);
    EXPECT_LT(part->ause, 0.2);
    EXPECT_GT(part->rank_correlation, 0.8);
  }
  EXPECT_EQ(figures.all->points, figures.seen->points + figures.hidden->points);
  EXPECT_EQ(figures.unknown, 0);
}

TEST(Calibration, CovariancesThatAreTooSmallCoverLessAndAreLessLikely) {
  const Sample right = Draw(5000, 1.0);
  const Sample small = Draw(5000, 0.04);
  const auto measure = [](const Sample& sample) {
    return *MeasureCalibration(sample.errors, sample.covariances, sample.is_seen).all;
  };
  // The ellipsoid of 95 % is as large as that of F(0.04 * 7.815) = 4.3 %.
  EXPECT_NEAR(measure(small).coverage_95, 0.0425, 0.012);
  EXPECT_GT(measure(small).negative_log_likelihood, measure(right).negative_log_likelihood + 10.0);
  // The order of the points is the same.
  EXPECT_EQ(measure(small).ause, measure(right).ause);
  EXPECT_EQ(measure(small).rank_correlation, measure(right).rank_correlation);
}

// For a unit covariance: -log of the density of the standard normal distribution.
TEST(Calibration, LikelihoodIsThatOfTheNormalDistribution) {
  const std::vector<Eigen::Vector3d> errors = {{1.0, 2.0, 2.0}, {0.0, 0.0, 0.0}};
  const std::vector<Eigen::Matrix3d> covariances = {Eigen::Matrix3d::Identity(),
                                                    Eigen::Matrix3d::Identity() * 4.0};
  const Calibration figures = *MeasureCalibration(errors, covariances, {1, 1}).all;
  const double constant = 1.5 * std::log(2.0 * M_PI);
  EXPECT_NEAR(figures.negative_log_likelihood,
              0.5 * (4.5 + constant + 1.5 * std::log(4.0) + constant),
              1e-12);
}

TEST(Calibration, OrderOfTheErrorsIsPerfectAndTheReverseIsWorseThanNone) {
  std::vector<Eigen::Vector3d> errors;
  std::vector<Eigen::Matrix3d> same_order, reverse;
  for (int i = 1; i <= 50; ++i) {
    errors.emplace_back(0.0, i, 0.0);
    same_order.push_back(Eigen::Matrix3d::Identity() * i);
    reverse.push_back(Eigen::Matrix3d::Identity() / i);
  }
  const std::vector<char> is_seen(50, 1);
  const Calibration good = *MeasureCalibration(errors, same_order, is_seen).all;
  EXPECT_EQ(good.ause, 0.0);
  EXPECT_NEAR(good.rank_correlation, 1.0, 1e-12);
  const Calibration bad = *MeasureCalibration(errors, reverse, is_seen).all;
  // The curves are (n + 1) / 2 and 50 - (n - 1) / 2; the mean error is their mean.
  EXPECT_NEAR(bad.ause, 2.0, 1e-12);
  EXPECT_NEAR(bad.rank_correlation, -1.0, 1e-12);
}

TEST(Calibration, LeavesOutPointsWithoutACovariance) {
  const double nan = std::nan("");
  const std::vector<Eigen::Vector3d> errors(4, Eigen::Vector3d::Ones());
  const CalibrationFigures figures = MeasureCalibration(errors,
                                                        {Eigen::Matrix3d::Identity(),
                                                         Eigen::Matrix3d::Zero(),
                                                         Eigen::Matrix3d::Constant(nan),
                                                         Eigen::Matrix3d::Identity()},
                                                        {1, 1, 0, 1});
  EXPECT_EQ(figures.unknown, 2);
  EXPECT_EQ(figures.all->points, 2);
  EXPECT_FALSE(figures.hidden.has_value());
}

TEST(ReadCovariances, NamesThePropertyThatIsMissing) {
  const TemporaryDirectory directory;
  const std::string path = directory / "cloud.ply";
  std::ofstream(path) << "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                         "property float y\nproperty float z\nproperty float xx\nend_header\n"
                         "0 0 0 1\n";
  EXPECT_THAT(ReadCovariances(path).status().message(),
              HasSubstr(path + ": element vertex has no property xy"));
}

}  // namespace
}  // namespace ceres_ed
