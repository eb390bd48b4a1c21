#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/image_io.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/run_program.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace fs = std::filesystem;

// Every file below a folder.
std::vector<std::string> FilesIn(const std::string& directory) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file()) {
      files.push_back(entry.path().lexically_relative(directory).string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

class EdSimulateTest : public ::testing::Test {
 protected:
  // A small sequence in `name`.
  ProgramResult Simulate(const std::string& scene,
                         const std::string& name,
                         const std::vector<std::string>& flags = {},
                         const RunOptions& options = {}) const {
    std::vector<std::string> arguments = {
        scene, "--output=" + (dir_ / name), "--width=64", "--height=48"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return RunProgramFile(AppPath("ed_simulate"), arguments, options);
  }

  void ExpectRefused(const ProgramResult& result, int code, const std::string& part) const {
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(SplitLines(result.err).size(), 1u) << result.err;
    EXPECT_THAT(result.err, StartsWith("ed_simulate: "));
    EXPECT_THAT(result.err, HasSubstr(part));
  }

  TemporaryDirectory dir_;
};

TEST_F(EdSimulateTest, WritesEveryPartOfASequence) {
  const ProgramResult result = Simulate("heart", "h", {"--frames=3", "--vertices=600"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, StartsWith((dir_ / "h") + ": 3 frames of heart, 64 x 48, "));
  EXPECT_EQ(FilesIn(dir_ / "h"),
            (std::vector<std::string>{"camera.txt",
                                      "color/000000.png",
                                      "color/000001.png",
                                      "color/000002.png",
                                      "depth/000000.png",
                                      "depth/000001.png",
                                      "depth/000002.png",
                                      "gt_mesh_000000.ply",
                                      "gt_vertices.f32",
                                      "info.json",
                                      "poses.txt"}));
  const auto camera = ReadCameraFile(dir_ / "h/camera.txt");
  ASSERT_TRUE(camera.ok());
  EXPECT_EQ(camera->camera.width, 64);
  EXPECT_EQ(camera->camera.fx, 56.0);
  EXPECT_EQ(ReadPosesFile(dir_ / "h/poses.txt")->size(), 3u);
  const auto mesh = LoadCloud(dir_ / "h/gt_mesh_000000.ply");
  ASSERT_TRUE(mesh.ok());
  EXPECT_NEAR(double(mesh->cloud.size()), 600.0, 60.0);
  EXPECT_EQ(fs::file_size(dir_ / "h/gt_vertices.f32"), 3 * 12 * mesh->cloud.size());
}

TEST_F(EdSimulateTest, WritesTheSameBytesForTheSameFlags) {
  const std::vector<std::string> flags = {"--frames=2"};
  ASSERT_EQ(Simulate("strip", "a", flags).exit_code, 0);
  ASSERT_EQ(Simulate("strip", "b", flags).exit_code, 0);
  ASSERT_EQ(Simulate("strip", "c", {"--frames=2", "--seed=2"}).exit_code, 0);
  const std::vector<std::string> files = FilesIn(dir_ / "a");
  EXPECT_EQ(FilesIn(dir_ / "b"), files);
  for (const std::string& file : files) {
    EXPECT_EQ(ReadBytes(dir_ / "a/" + file), ReadBytes(dir_ / "b/" + file)) << file;
  }
  EXPECT_NE(ReadBytes(dir_ / "a/depth/000001.png"), ReadBytes(dir_ / "c/depth/000001.png"));
}

TEST_F(EdSimulateTest, LeavesOutColourAndTruthWhenTold) {
  const ProgramResult result =
      Simulate("plane", "p", {"--frames=2", "--color=false", "--truth=false", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_EQ(FilesIn(dir_ / "p"),
            (std::vector<std::string>{"camera.txt",
                                      "depth/000000.png",
                                      "depth/000001.png",
                                      "info.json",
                                      "mask/000001.png",
                                      "poses.txt"}));
}

TEST_F(EdSimulateTest, AddsNoNoiseWhenToldNotTo) {
  ASSERT_EQ(Simulate("plane", "p", {"--frames=1", "--noise=0"}).exit_code, 0);
  const auto depth = ReadDepthImage(dir_ / "p/depth/000000.png", 10000.0);
  ASSERT_TRUE(depth.ok());
  // A sheet at rest, seen straight on: one number in the sheet, 0 around it.
  for (const float z : depth->pixels()) EXPECT_TRUE(z == 0.0F || z == (*depth)(32, 24)) << z;
  EXPECT_GT((*depth)(32, 24), 0.2F);
}

TEST_F(EdSimulateTest, MakesAStripAsLongAsItsNodesNeed) {
  ASSERT_EQ(Simulate("strip", "s", {"--nodes_hint=600", "--truth=false"}).exit_code, 0);
  const auto poses = ReadPosesFile(dir_ / "s/poses.txt");
  ASSERT_TRUE(poses.ok());
  EXPECT_EQ(poses->size(), 21u);
  const double way = poses->back().world_from_camera.translation.x() -
                     poses->front().world_from_camera.translation.x();
  // One more view of 0.1 m * 64 / 56.
  EXPECT_NEAR(way, 0.1 * 64 / 56, 1e-9);
}

TEST_F(EdSimulateTest, RefusesBadFlagsInOneLine) {
  ExpectRefused(Simulate("liver", "x"), 1, "'liver', expected one of strip, heart, kidney");
  ExpectRefused(Simulate("heart", "x", {"--frames=-2"}), 1, "--frames=-2, expected 1 or more");
  ExpectRefused(Simulate("heart", "x", {"--frames=0"}), 1, "--frames=0, expected 1 or more");
  ExpectRefused(Simulate("heart", "x", {"--frames=two"}), 1, "--frames=two");
  ExpectRefused(
      Simulate("heart", "x", {"--noise=-1"}), 1, "--noise=-1, expected a finite number >= 0");
  ExpectRefused(Simulate("heart", "x", {"--noise=inf"}), 1, "--noise=inf, expected a finite");
  ExpectRefused(Simulate("heart", "x", {"--nodes_hint=900"}), 1, "nodes_hint is 900");
  ExpectRefused(Simulate("strip", "x", {"--nodes_hint=5"}),
                1,
                "--nodes_hint=5, expected a whole number from 300 to 1000000");
  ExpectRefused(Simulate("strip", "x", {"--nodes_hint=9000", "--frames=3"}), 1, "frames is 3");
  ExpectRefused(Simulate("strip", "x", {"--vertices=900"}), 1, "vertices is 900");
  ExpectRefused(Simulate("heart", "x", {"--width=0"}),
                1,
                "--width=0, expected a whole number from 16 to 8192");
  ExpectRefused(RunProgramFile(AppPath("ed_simulate"), {"heart"}), 1, "--output is required");
  EXPECT_FALSE(fs::exists(dir_ / "x"));
}

TEST_F(EdSimulateTest, RefusesAnOutputThatItCannotUse) {
  WriteBytes(dir_ / "file", "");
  ExpectRefused(Simulate("plane", "file", {"--frames=1"}), 2, dir_ / "file");
  ExpectRefused(Simulate("plane", "file/below", {"--frames=1"}), 2, dir_ / "file");
}

TEST_F(EdSimulateTest, ReplacesASequenceOnlyWhenTold) {
  ASSERT_EQ(Simulate("plane", "p", {"--frames=3"}).exit_code, 0);
  ExpectRefused(
      Simulate("plane", "p", {"--frames=1"}), 2, "expected an empty folder or --overwrite");
  EXPECT_TRUE(fs::exists(dir_ / "p/depth/000002.png"));
  ASSERT_EQ(Simulate("plane", "p", {"--frames=1", "--overwrite"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(dir_ / "p/depth/000002.png"));
  EXPECT_FALSE(fs::exists(dir_ / "p/mask/000001.png"));
  EXPECT_EQ(ReadPosesFile(dir_ / "p/poses.txt")->size(), 1u);
}

TEST_F(EdSimulateTest, LeavesAShorterSequenceThatIsWholeWhenItIsStopped) {
  RunOptions options;
  options.signal = SIGINT;
  options.signal_after_s = 1.0;
  const ProgramResult result = Simulate("strip", "s", {"--frames=100000"}, options);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_THAT(result.err, HasSubstr("stopped at frame "));
  std::size_t frames = 0;
  for (const auto& entry : fs::directory_iterator(dir_ / "s/depth")) {
    const auto depth = ReadDepthImage(entry.path().string(), 10000.0);
    EXPECT_TRUE(depth.ok()) << entry.path();
    ++frames;
  }
  const auto poses = ReadPosesFile(dir_ / "s/poses.txt");
  ASSERT_TRUE(poses.ok());
  EXPECT_EQ(poses->size(), frames);
}

}  // namespace
}  // namespace ceres_ed
