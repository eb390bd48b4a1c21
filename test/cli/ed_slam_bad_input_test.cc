// ed_slam on what users get wrong, and on sequences with damage.
#include <filesystem>

#include <gmock/gmock.h>
#include <test/cli/ed_slam_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class EdSlamBadInputTest : public EdSlamTest {
 protected:
  EdSlamBadInputTest() { WriteBumpySequence(Sequence(), 4); }

  std::string DepthPath(int frame) const {
    return Sequence() + "/depth/" + FrameName(frame, "png");
  }

  // One line, and the exit code.
  void ExpectRefused(const ProgramResult& result, int exit_code, const std::string& sentence) {
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr(sentence));
  }
};

TEST_F(EdSlamBadInputTest, RefusesFlagsThatMakeNoSense) {
  const ProgramResult bare = RunProgramFile(AppPath("ed_slam"), {Sequence()});
  ExpectRefused(bare, 1, "flag --output is required");
  ExpectRefused(
      Run("out", {"--mode=fast"}), 1, "--mode=fast, expected batch or two_level or marginal");
  ExpectRefused(Run("out", {"--level2=never"}), 1, "--level2=never, expected full or lazy");
  ExpectRefused(
      Run("out", {"--camera=free"}), 1, "--camera=free, expected estimate or fixed or given");
  for (const char* flag : {"--rings=-1",
                           "--step=0",
                           "--first=-2",
                           "--threads=-1",
                           "--w_reg=-1",
                           "--w_data=inf",
                           "--node_spacing=-0.1",
                           "--live_every=-1",
                           "--checkpoint_every=-1",
                           "--nodes_in_view=0",
                           "--max_observations=99",
                           "--time_limit_s=-1"}) {
    ExpectRefused(Run("out", {flag}), 1, std::string(flag) + ", expected ");
  }
  ExpectRefused(Run("out", {"--first=3", "--last=1"}), 1, "last");
  ExpectRefused(Run("out", {"--energy=nonsense"}), 1, "--energy: ");
  EXPECT_FALSE(Exists("out"));
}

TEST_F(EdSlamBadInputTest, RefusesASequenceThatCannotBeOpened) {
  std::filesystem::create_directories(dir_ / "empty");
  const auto run = [&](const std::string& sequence) {
    return RunProgramFile(AppPath("ed_slam"), {sequence, "--output=" + (dir_ / "out")});
  };
  ExpectRefused(run(dir_ / "empty"), 2, "empty");
  ExpectRefused(run(dir_ / "missing"), 2, "missing");
  WriteBytes(Sequence() + "/camera.txt", "0 90 47.5 35.5 96 72 50000\n");
  ExpectRefused(run(Sequence()), 2, "fx is '0', expected a focal length > 0 pixels");
  WriteBytes(Sequence() + "/camera.txt", "nan 90 47.5 35.5 96 72 50000\n");
  ExpectRefused(run(Sequence()), 2, "camera.txt: line 1: fx is 'nan'");
  EXPECT_FALSE(Exists("out"));
}

TEST_F(EdSlamBadInputTest, RefusesAnOutputThatCannotBeWritten) {
  WriteBytes(dir_ / "out", "a file");
  ExpectRefused(Run("out"), 2, "out: cannot be created as a folder: ");
  EXPECT_EQ(ReadBytes(dir_ / "out"), "a file");
}

TEST_F(EdSlamBadInputTest, SkipsAnUnreadableFrameInTheMiddle) {
  WriteBytes(DepthPath(1), "no picture");
  const ProgramResult result = Run("out");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("warning: "));
  EXPECT_THAT(result.err, HasSubstr("000001.png"));
  EXPECT_THAT(result.err, HasSubstr(": frame skipped"));
  EXPECT_THAT(Statuses(), ElementsAre("initialized", "skipped", "tracked", "tracked"));
  EXPECT_FALSE(Exists("out/live/000001.ply"));
  EXPECT_EQ(SplitLines(ReadBytes(dir_ / "out/trajectory.txt")).size(), 4u);
  const nlohmann::json report = Report();
  EXPECT_EQ(report["frames"]["skipped"], 1);
  EXPECT_EQ(report["warnings"].size(), 1u);
  EXPECT_EQ(report["status"], "done");
}

TEST_F(EdSlamBadInputTest, SkipsAFrameWithoutAnyDepth) {
  const DepthImage none(BumpyCamera().width, BumpyCamera().height, 0.0f);
  ASSERT_TRUE(WriteDepthImage(DepthPath(0), none, 1000.0).ok());
  ASSERT_TRUE(WriteDepthImage(DepthPath(2), none, 1000.0).ok());
  const ProgramResult result = Run("out");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(Statuses(), ElementsAre("skipped", "initialized", "skipped", "tracked"));
  EXPECT_THAT(result.err, HasSubstr("frame 0: no depth that could be used: frame skipped"));
  EXPECT_THAT(result.err, HasSubstr("frame 2: no depth"));
}

TEST_F(EdSlamBadInputTest, SaysSoWhenNoFrameIsOfUse) {
  for (int frame = 0; frame < 4; ++frame) WriteBytes(DepthPath(frame), "no picture");
  const ProgramResult result = Run("out");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("none of its 4 frames could be used"));
  EXPECT_EQ(Frames().size(), 4u);
  EXPECT_EQ(Report()["status"], "failed");
  EXPECT_FALSE(Exists("out/map.ply"));
}

TEST_F(EdSlamBadInputTest, TellsOfManyDamagedFramesInAFewLines) {
  WriteBumpySequence(Sequence(), 12);
  for (int frame = 1; frame < 11; ++frame) WriteBytes(DepthPath(frame), "no picture");
  const ProgramResult result = Run("out");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(Report()["warnings"].size(), 5u);
  EXPECT_THAT(result.err, HasSubstr("(further warnings of this kind are not shown)"));
  EXPECT_EQ(Report()["frames"]["skipped"], 10);
}

TEST_F(EdSlamBadInputTest, StopsWhereTheSizeChanges) {
  const DepthImage small(48, 36, 0.1f);
  ASSERT_TRUE(WriteDepthImage(DepthPath(2), small, 50000.0).ok());
  const ProgramResult result = Run("out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("000002.png"));
  EXPECT_THAT(result.err, HasSubstr("48 x 36"));
  // What was done before is there.
  EXPECT_THAT(Statuses(), ElementsAre("initialized", "tracked"));
  EXPECT_GT(Load("out/map.ply").cloud.size(), 100u);
  EXPECT_EQ(Report()["status"], "failed");
}

TEST_F(EdSlamBadInputTest, WarnsOfDepthInTheWrongUnit) {
  for (const auto& [units, word] : {std::pair<const char*, const char*>{"50000000", "1 mm"},
                                    std::pair<const char*, const char*>{"40", "100 m"}}) {
    WriteBytes(Sequence() + "/camera.txt", std::string("90 90 47.5 35.5 96 72 ") + units + "\n");
    const ProgramResult result = Run("out", {"--overwrite"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("warning: "));
    EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_THAT(result.err, HasSubstr("With depth_units_per_metre=1000 (millimetres) it would be"));
    EXPECT_EQ(Report()["warnings"].size(), 1u);
  }
}

TEST_F(EdSlamBadInputTest, WarnsOfTheUnitAtTheFirstFrameWithDepth) {
  WriteBytes(Sequence() + "/camera.txt", "90 90 47.5 35.5 96 72 40\n");
  const DepthImage none(BumpyCamera().width, BumpyCamera().height, 0.0f);
  ASSERT_TRUE(WriteDepthImage(DepthPath(0), none, 1000.0).ok());
  EXPECT_THAT(Run("out").err, HasSubstr("depth_units_per_metre=1000"));
}

TEST_F(EdSlamBadInputTest, GivenCamerasNeedPoses) {
  WriteBytes(Sequence() + "/poses.txt", "1 0 0 0 0 0 0 1\n");
  const ProgramResult some = Run("out", {"--camera=given"});
  EXPECT_EQ(some.exit_code, 0) << some.err;
  EXPECT_THAT(some.err, HasSubstr("frame 0: has no pose: frame skipped"));
  EXPECT_THAT(Statuses(), ElementsAre("skipped", "initialized", "skipped", "skipped"));
  std::filesystem::remove(Sequence() + "/poses.txt");
  ExpectRefused(Run("out", {"--camera=given", "--overwrite"}), 2, "has no poses, expected some");
}

}  // namespace
}  // namespace ceres_ed
