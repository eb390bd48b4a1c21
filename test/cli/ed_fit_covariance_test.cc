// ed_fit --covariance: a standard deviation for each vertex, in the target's unit.
#include <ceres_ed/evaluation/covariance_calibration.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <test/cli/run_program.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

class EdFitCovarianceTest : public ::testing::Test {
 protected:
  static std::string Shipped(const std::string& name) {
    return std::string(CERES_ED_SOURCE_DIR) + "/data/heart_partial/" + name;
  }

  // Fits `source` to `target` and returns std_dev of each vertex of the result.
  std::vector<double> Deviations(const std::string& source,
                                 const std::string& target,
                                 const std::vector<std::string>& flags = {}) const {
    std::vector<std::string> arguments = {
        source, target, "--output=" + Out(), "--report=" + (dir_ / "report.json"), "--covariance"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const ProgramResult run = RunProgramFile(AppPath("ed_fit"), arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const StatusOr<LoadedCloud> loaded = LoadCloud(Out());
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    if (!loaded.ok()) return {};
    const PlyProperty* const property = loaded->document.Find("vertex")->Find("std_dev");
    EXPECT_NE(property, nullptr);
    return property != nullptr ? property->values : std::vector<double>();
  }

  // The file `path` with its points times `factor`.
  std::string Scaled(const std::string& path, double factor, const std::string& name) const {
    const StatusOr<LoadedCloud> loaded = LoadCloud(path);
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    std::vector<Eigen::Vector3d> points = loaded->cloud.points;
    for (Eigen::Vector3d& point : points) point *= factor;
    EXPECT_TRUE(SaveCloud(dir_ / name, *loaded, points, nullptr).ok());
    return dir_ / name;
  }

  std::string Out() const { return dir_ / "out.ply"; }

  nlohmann::json Report() const {
    return nlohmann::json::parse(std::ifstream(dir_ / "report.json"));
  }

  TemporaryDirectory dir_;
};

TEST_F(EdFitCovarianceTest, IsLargerWhereTheTargetShowsNothing) {
  const std::vector<double> deviations = Deviations(Shipped("source.ply"), Shipped("target.ply"));
  const StatusOr<LoadedCloud> truth = LoadCloud(Shipped("gt.ply"));
  const StatusOr<LoadedCloud> target = LoadCloud(Shipped("target.ply"));
  ASSERT_TRUE(truth.ok() && target.ok());
  ASSERT_EQ(deviations.size(), truth->cloud.size());
  std::vector<double> seen;
  std::vector<double> hidden;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    ASSERT_GT(deviations[i], 0.0) << i;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& point : target->cloud.points) {
      nearest = std::min(nearest, (point - truth->cloud.points[i]).norm());
    }
    // Metres, of a heart of 0.1 m.
    if (nearest < 0.003) seen.push_back(deviations[i]);
    if (nearest > 0.015) hidden.push_back(deviations[i]);
  }
  ASSERT_GT(seen.size(), 100u);
  ASSERT_GT(hidden.size(), 100u);
  // What is seen may have slid along itself, which is most of its deviation.
  EXPECT_GT(Median(hidden), 1.5 * Median(seen));
  const nlohmann::json report = Report()["covariance"];
  EXPECT_NEAR(report["median"], Median(deviations), 0.01 * Median(deviations));
  EXPECT_EQ(report["undetermined_points"], 0);
  EXPECT_TRUE(report["undetermined_nodes"].empty());
  EXPECT_GE(report["max"], report["p95"]);
}

TEST_F(EdFitCovarianceTest, FileHasTheCovarianceOfEachVertex) {
  const std::string path = dir_ / "covariance.ply";
  const ProgramResult run = RunProgramFile(
      AppPath("ed_fit"),
      {Shipped("source.ply"), Shipped("target.ply"), "--output=" + Out(), "--covariance=" + path});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const StatusOr<LoadedCloud> fitted = LoadCloud(Out());
  const StatusOr<LoadedCloud> written = LoadCloud(path);
  const StatusOr<std::vector<Eigen::Matrix3d>> covariances = ReadCovariances(path);
  ASSERT_TRUE(fitted.ok() && written.ok() && covariances.ok());
  ASSERT_EQ(covariances->size(), fitted->cloud.size());
  const std::vector<double>& deviations = fitted->document.Find("vertex")->Find("std_dev")->values;
  for (std::size_t p = 0; p < covariances->size(); ++p) {
    EXPECT_LT((written->cloud.points[p] - fitted->cloud.points[p]).norm(), 1e-6);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen((*covariances)[p]);
    ASSERT_GT(eigen.eigenvalues()[0], 0.0) << p;
    ASSERT_NEAR(std::sqrt(eigen.eigenvalues().sum()), deviations[p], 1e-6 * deviations[p]) << p;
  }
}

// The truth is that of the generator. The scale was fitted to this pair among others, so the bounds
// hold the form of the covariances; scripts/bench_uncertainty.py measures them on other pairs.
TEST_F(EdFitCovarianceTest, EllipsoidsCoverTheTruth) {
  const std::string path = dir_ / "covariance.ply";
  ASSERT_EQ(RunProgramFile(AppPath("ed_fit"),
                           {Shipped("source.ply"),
                            Shipped("target.ply"),
                            "--output=" + Out(),
                            "--covariance=" + path})
                .exit_code,
            0);
  const ProgramResult run = RunProgramFile(AppPath("ed_eval"),
                                           {Out(),
                                            Shipped("target.ply"),
                                            "--truth=" + Shipped("gt.ply"),
                                            "--calibration=" + path,
                                            "--report=" + (dir_ / "eval.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("hidden from the target"));
  const nlohmann::json report =
      nlohmann::json::parse(std::ifstream(dir_ / "eval.json"))["calibration"];
  EXPECT_EQ(report["unknown"], 0);
  EXPECT_GT(report["all"]["rank_correlation"], 0.6);
  EXPECT_LT(report["all"]["ause"], 0.5);
  EXPECT_GT(report["all"]["coverage_95"], 0.75);
  // What lies behind is bent by more than the seen side alone shows.
  EXPECT_GT(report["hidden"]["coverage_95"], 0.78);
}

TEST_F(EdFitCovarianceTest, IsInTheUnitOfTheTarget) {
  const std::vector<double> metres = Deviations(Shipped("source.ply"), Shipped("target.ply"));
  const std::vector<double> millimetres =
      Deviations(Scaled(Shipped("source.ply"), 1000.0, "source.ply"),
                 Scaled(Shipped("target.ply"), 1000.0, "target.ply"));
  ASSERT_EQ(metres.size(), millimetres.size());
  // Points are written with the digits of floats, and a fit goes on from there.
  const double ratio = Median(millimetres) / Median(metres);
  EXPECT_NEAR(ratio, 1000.0, 10.0);
}

TEST_F(EdFitCovarianceTest, IsLeftOutWithAWarningWhereADeformationIs) {
  std::vector<std::string> arguments = {Shipped("source.ply"),
                                        Shipped("target.ply"),
                                        "--output=" + Out(),
                                        "--report=" + (dir_ / "report.json"),
                                        "--covariance",
                                        "--time_limit_s=0.05"};
  const ProgramResult run = RunProgramFile(AppPath("ed_fit"), arguments);
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_THAT(run.err, HasSubstr("no standard deviations: the fit ended early"));
  EXPECT_TRUE(Report()["covariance"].is_null());
}

TEST_F(EdFitCovarianceTest, IsThereInEveryModeAndTheSameAtAnyNumberOfThreads) {
  for (const char* mode : {"two_level", "marginal"}) {
    const std::vector<std::string> flags = {std::string("--mode=") + mode};
    const std::vector<double> one = Deviations(Shipped("source.ply"), Shipped("target.ply"), flags);
    const std::string bytes = ReadBytes(Out());
    Deviations(Shipped("source.ply"),
               Shipped("target.ply"),
               {std::string("--mode=") + mode, "--threads=2"});
    EXPECT_TRUE(ReadBytes(Out()) == bytes) << mode;
    EXPECT_GT(Median(one), 0.0);
  }
}

}  // namespace
}  // namespace ceres_ed
