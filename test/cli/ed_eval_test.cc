#include <ceres_ed/io/cloud_io.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <test/cli/run_program.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Tests run at once, so each process has a folder of its own.
std::string TempPath(const std::string& name) {
  static const TemporaryDirectory folder;
  return folder / name;
}

// A square of side 2 in the plane z = `height`; its diagonal is sqrt(8).
std::string WriteSquare(const std::string& name, double height) {
  PointCloud square;
  square.points = {{0, 0, height}, {2, 0, height}, {2, 2, height}, {0, 2, height}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::string path = TempPath(name);
  CloudWriteOptions options;
  options.double_precision = true;
  EXPECT_TRUE(WriteCloud(path, square, options).ok());
  return path;
}

ProgramResult Eval(const std::vector<std::string>& arguments) {
  return RunProgramFile(AppPath("ed_eval"), arguments);
}

TEST(EdEval, ReportsKnownDistances) {
  const std::string report_path = TempPath("report.json");
  const ProgramResult result = Eval({WriteSquare("result.ply", 0.5),
                                     WriteSquare("target.ply", 0.0),
                                     "--source=" + WriteSquare("source.ply", 3.0),
                                     "--truth=" + WriteSquare("truth.ply", 0.25),
                                     "--report=" + report_path});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("symmetric                          0.5 "));
  EXPECT_THAT(result.out, HasSubstr("triangles flipped: 0, degenerate: 0"));

  const auto report = nlohmann::json::parse(std::ifstream(report_path));
  EXPECT_EQ(report["program"], "ed_eval");
  EXPECT_NEAR(report["diagonal"], std::sqrt(8.0), 1e-12);
  for (const char* way : {"forward", "backward", "symmetric"}) {
    EXPECT_NEAR(report[way]["mean"], 0.5, 1e-12) << way;
    EXPECT_NEAR(report[way]["mean_percent"], 50.0 / std::sqrt(8.0), 1e-12) << way;
  }
  EXPECT_NEAR(report["truth"]["max"], 0.25, 1e-12);
  EXPECT_EQ(report["shape"]["edge_mean"], 0.0);
  EXPECT_NEAR(report["normal_error_deg"], 0.0, 1e-5);
}

TEST(EdEval, LeavesOutWhatItWasNotGiven) {
  const std::string report_path = TempPath("short.json");
  const ProgramResult result = Eval({WriteSquare("result2.ply", 0.5),
                                     WriteSquare("target2.ply", 0.0),
                                     "--report=" + report_path});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto report = nlohmann::json::parse(std::ifstream(report_path));
  EXPECT_TRUE(report["truth"].is_null());
  EXPECT_TRUE(report["shape"].is_null());
}

TEST(EdEval, WritesTheErrorOfEachPoint) {
  const std::string error_path = TempPath("error.ply");
  const ProgramResult result = Eval({WriteSquare("result3.ply", 0.5),
                                     WriteSquare("target3.ply", 0.0),
                                     "--error_ply=" + error_path});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const StatusOr<LoadedCloud> loaded = LoadCloud(error_path);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  const PlyElement* vertices = loaded->document.Find("vertex");
  ASSERT_NE(vertices->Find("error"), nullptr);
  EXPECT_EQ(vertices->Find("error")->values, (std::vector<double>{0.5, 0.5, 0.5, 0.5}));
  ASSERT_NE(vertices->Find("red"), nullptr);
  EXPECT_EQ(vertices->Find("red")->values[0], 255.0);
  EXPECT_EQ(vertices->Find("blue")->values[0], 0.0);
}

TEST(EdEval, MakesTheFoldersOfItsOutputs) {
  const std::string folder = TempPath("new_folder");
  std::filesystem::remove_all(folder);
  const ProgramResult result = Eval({WriteSquare("result4.ply", 0.5),
                                     WriteSquare("target4.ply", 0.0),
                                     "--report=" + folder + "/report.json",
                                     "--error_ply=" + folder + "/error/error.ply"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder + "/report.json"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/error/error.ply"));
}

TEST(EdEval, NamesTheInputThatIsBad) {
  const std::string good = WriteSquare("good.ply", 0.0);
  const std::string missing = "/nowhere/missing.ply";
  const std::vector<std::vector<std::string>> bad = {{missing, good},
                                                     {good, missing},
                                                     {good, good, "--source=" + missing},
                                                     {good, good, "--truth=" + missing}};
  for (const auto& arguments : bad) {
    const ProgramResult result = Eval(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
    EXPECT_THAT(result.err, StartsWith("ed_eval: "));
    EXPECT_THAT(result.err, HasSubstr(missing));
  }
}

TEST(EdEval, RefusesATruthOfAnotherSize) {
  PointCloud three;
  three.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  ASSERT_TRUE(WriteCloud(TempPath("three.ply"), three).ok());
  const std::string good = WriteSquare("four.ply", 0.0);
  const ProgramResult result = Eval({good, good, "--truth=" + TempPath("three.ply")});
  EXPECT_EQ(result.exit_code, 2);
  ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
  EXPECT_THAT(result.err, HasSubstr("3"));
  EXPECT_THAT(result.err, HasSubstr("4"));
}

}  // namespace
}  // namespace ceres_ed
