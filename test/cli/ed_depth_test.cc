#include <ceres_ed/evaluation/sequence_files.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/util/statistics.h>

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

namespace fs = std::filesystem;

class EdDepthTest : public ::testing::Test {
 protected:
  // Simulates a heart in the folder `name`.
  void Simulate(const std::string& name, const std::vector<std::string>& flags) const {
    std::vector<std::string> arguments = {
        "heart", "--output=" + (dir_ / name), "--width=320", "--height=240", "--vertices=4000"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const ProgramResult result = RunProgramFile(AppPath("ed_simulate"), arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  ProgramResult Run(const std::string& input, const std::vector<std::string>& flags) const {
    std::vector<std::string> arguments = {dir_ / input};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return RunProgramFile(AppPath("ed_depth"), arguments);
  }

  TemporaryDirectory dir_;
};

TEST_F(EdDepthTest, WritesTheDepthOfSimulatedPictures) {
  Simulate("stereo", {"--stereo", "--frames=3"});
  Simulate("exact", {"--noise=0", "--frames=3"});
  EXPECT_TRUE(fs::exists(dir_ / "stereo/stereo.txt"));
  EXPECT_FALSE(fs::exists(dir_ / "stereo/depth"));
  const ProgramResult result = Run("stereo", {"--output=" + (dir_ / "out"), "--first=1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith((dir_ / "out") + ": 2 frames of 320 x 240, depth of "));
  EXPECT_THAT(result.err, StartsWith("ed_depth: native_stereo (guessed: there is stereo.txt), "));
  const auto found = OpenSequence(dir_ / "out");
  ASSERT_TRUE(found.ok()) << found.status().message();
  EXPECT_EQ((*found)->frame_number(0), 1);
  ASSERT_NE((*found)->given_pose(0), nullptr);
  const auto exact = OpenSequence(dir_ / "exact");
  ASSERT_TRUE(exact.ok());
  const DepthImage depth = (*found)->Load(0)->depth;
  const DepthImage truth = (*exact)->Load(1)->depth;
  std::vector<double> errors;
  int seen = 0, beside = 0;
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    const float z = depth.pixels()[i], true_z = truth.pixels()[i];
    seen += true_z > 0.0F ? 1 : 0;
    beside += z > 0.0F && true_z == 0.0F ? 1 : 0;
    if (z > 0.0F && true_z > 0.0F) errors.push_back(static_cast<double>(z - true_z));
  }
  EXPECT_GT(errors.size(), 0.85 * seen);
  EXPECT_LT(beside, 0.02 * seen);
  EXPECT_LT(RobustDeviation(errors), 0.5e-3);
  // The truth comes along.
  EXPECT_TRUE(fs::exists(dir_ / "out/gt_vertices.f32"));
  const auto info = nlohmann::json::parse(std::ifstream(dir_ / "out/info.json"));
  EXPECT_EQ(info["frames"], 2);
  EXPECT_EQ(info["baseline_m"], 0.005);
}

// Tracked from its pictures, the simulated heart is where it is to a fraction of a millimetre.
TEST_F(EdDepthTest, SimulatedPicturesAreTrackedByEdSlam) {
  Simulate("stereo", {"--stereo", "--frames=8"});
  const ProgramResult slam = RunProgramFile(
      AppPath("ed_slam"), {dir_ / "stereo", "--output=" + (dir_ / "run"), "--threads=2"});
  ASSERT_EQ(slam.exit_code, 0) << slam.err;
  const ProgramResult eval = RunProgramFile(AppPath("ed_eval"),
                                            {"--sequence=" + (dir_ / "stereo"),
                                             "--result=" + (dir_ / "run"),
                                             "--report=" + (dir_ / "eval.json")});
  ASSERT_EQ(eval.exit_code, 0) << eval.err;
  const auto report = nlohmann::json::parse(std::ifstream(dir_ / "eval.json"));
  EXPECT_LT(report["truth"]["summary"]["tracking_seen_mean"]["max"], 0.5e-3);
  EXPECT_LT(report["depth"]["summary"]["residual_median"]["max"], 0.3e-3);
  const auto log = ReadFrameLog(dir_ / "run/frames.csv");
  ASSERT_TRUE(log.ok());
  ASSERT_NE(log->Find("t_stereo"), nullptr);
  for (const double share : *log->Find("valid_share")) EXPECT_GT(share, 0.2);
  // The same bytes with one thread.
  const ProgramResult again = RunProgramFile(
      AppPath("ed_slam"), {dir_ / "stereo", "--output=" + (dir_ / "again"), "--threads=1"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto bytes = [this](const std::string& name) {
    std::ifstream file(dir_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("run/map.ply"), bytes("again/map.ply"));
}

TEST_F(EdDepthTest, RefusesAWrongCommandLine) {
  const auto expect = [this](const std::vector<std::string>& flags, int code, const char* part) {
    const ProgramResult result = Run("none", flags);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(part));
    EXPECT_EQ(result.out, "");
  };
  const std::string output = "--output=" + (dir_ / "out");
  expect({}, 1, "flag --output is required");
  expect({output}, 2, "no such folder");
  expect({output, "--window=4"}, 1, "window is 4, expected an odd number of pixels");
  expect({output, "--mode=bm"}, 1, "--mode=bm, expected sgbm or hh or 3way or hh4");
  expect({output, "--disparity_sigma=0"}, 1, "--disparity_sigma=0");
}

TEST_F(EdDepthTest, ReplacesASequenceOnlyOnRequest) {
  Simulate("stereo", {"--stereo", "--frames=1"});
  const std::string output = "--output=" + (dir_ / "out");
  ASSERT_EQ(Run("stereo", {output, "-q"}).exit_code, 0);
  EXPECT_EQ(Run("stereo", {output}).exit_code, 2);
  EXPECT_EQ(Run("stereo", {output, "--overwrite"}).exit_code, 0);
  EXPECT_EQ(Run("stereo", {"--output=" + (dir_ / "stereo"), "--overwrite"}).exit_code, 1);
  EXPECT_TRUE(fs::exists(dir_ / "stereo/left/000000.png"));
}

TEST_F(EdDepthTest, NoFrameThatCanBeReadGivesNoResult) {
  Simulate("stereo", {"--stereo", "--frames=1"});
  std::ofstream(dir_ / "stereo/right/000000.png") << "damaged";
  const ProgramResult result = Run("stereo", {"--output=" + (dir_ / "out")});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("none of its 1 frames could be read"));
}

}  // namespace
}  // namespace ceres_ed
