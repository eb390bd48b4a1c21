// ed_slam that does not get to its end, and that goes on from there.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <test/cli/ed_slam_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

constexpr int kNumFrames = 24;

// A sheet that heaves and a camera that moves, with points to follow.
class EdSlamStopTest : public EdSlamTest {
 protected:
  EdSlamStopTest() {
    BumpyScene scene;
    scene.heave = 0.001;
    WriteBumpySequence(Sequence(), kNumFrames, scene);
    PointCloud cloud;
    for (const int u : {20, 60}) {
      cloud.points.push_back(BumpyCamera().BackProject(u, 36, scene.Depth(u, 36, 0)));
    }
    EXPECT_TRUE(WriteCloud(dir_ / "points.ply", cloud).ok());
  }

  ProgramResult RunTracked(const std::string& output,
                           std::vector<std::string> flags = {},
                           const RunOptions& options = {}) const {
    flags.push_back("--track=" + (dir_ / "points.ply"));
    flags.push_back("--checkpoint_every=5");
    return Run(output, flags, options);
  }

  // Holds when frames.csv of "out" has so many rows: the run is in the middle, however fast it is.
  std::function<bool()> HasRows(std::size_t rows) const {
    return [path = dir_ / "out/frames.csv", rows] {
      std::ifstream file(path);
      std::size_t lines = 0;
      for (std::string line; std::getline(file, line);) ++lines;
      return lines > rows;
    };
  }

  // Rows are complete, and what they and the other files tell of is there and whole.
  void ExpectWhole(const std::string& output) const {
    for (const char* name : {"frames.csv", "trajectory.txt", "tracks.csv"}) {
      const std::string bytes = ReadBytes(dir_ / (output + "/" + name));
      EXPECT_TRUE(bytes.empty() || bytes.back() == '\n') << name;
    }
    for (const char* name : {"map.ply", "graph.ply"}) {
      EXPECT_TRUE(!Exists(output + "/" + name) || Load(output + "/" + name).cloud.size() > 10u);
    }
    EXPECT_TRUE(!Exists(output + "/report.json") || Report(output)["program"] == "ed_slam");
    if (!Exists(output + "/frames.csv")) return;
    const std::size_t poses = SplitLines(ReadBytes(dir_ / (output + "/trajectory.txt"))).size();
    auto rows = Frames(output);
    EXPECT_GE(poses, rows.empty() ? 0u : rows.size() + 1);
    for (auto& row : rows) {
      const std::string name = FrameName(std::stoi(row["frame"]), "ply");
      EXPECT_EQ(std::to_string(Load(output + "/live/" + name).cloud.size()), row["map_points"]);
    }
  }
};

TEST_F(EdSlamStopTest, InterruptWritesWhatThereIsAfterTheFrameAtHand) {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove_all(dir_ / "out");
    RunOptions options;
    options.signal = signal;
    options.signal_when = HasRows(3);
    const ProgramResult result = RunTracked("out", {}, options);
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_THAT(result.err, HasSubstr("ed_slam: interrupted after frame "));
    EXPECT_THAT(result.err, HasSubstr("out"));
    const nlohmann::json report = Report();
    EXPECT_EQ(report["status"], "interrupted");
    EXPECT_EQ(report["frames"]["processed"], Frames().size());
    EXPECT_EQ(std::to_string(Load("out/map.ply").cloud.size()), Frames().back()["map_points"]);
    EXPECT_LT(Frames().size(), 24u);
    ExpectWhole("out");
  }
}

TEST_F(EdSlamStopTest, TimeLimitTakesOneFrameAtLeast) {
  const ProgramResult result = RunTracked("out", {"--time_limit_s=1e-6"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, HasSubstr("time limit reached after frame 0, results so far in "));
  EXPECT_EQ(Frames().size(), 1u);
  EXPECT_EQ(Report()["status"], "time_limit");
  ExpectWhole("out");
}

TEST_F(EdSlamStopTest, AKilledRunIsWholeAndGoesOnToTheSameBytes) {
  ASSERT_EQ(RunTracked("whole").exit_code, 0);
  int killed = 0;
  int resumed_in_the_middle = 0;
  // Before, at and between the checkpoints of frames 4, 9, 14 and so on.
  for (const std::size_t rows : {1, 5, 6, 11, 15}) {
    std::filesystem::remove_all(dir_ / "out");
    RunOptions options;
    options.signal = SIGKILL;
    options.signal_when = HasRows(rows);
    if (RunTracked("out", {}, options).signal == SIGKILL) ++killed;
    ExpectWhole("out");
    resumed_in_the_middle += Exists("out/checkpoint.cbor") ? 1 : 0;
    const ProgramResult result = RunTracked("out", {"--resume", "--threads=2"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    ExpectSameContents("whole", "out");
    EXPECT_EQ(Report()["frames"], Report("whole")["frames"]);
  }
  EXPECT_GE(killed, 3);
  EXPECT_GE(resumed_in_the_middle, 2);
}

TEST_F(EdSlamStopTest, AStoppedRunGoesOnToTheSameBytes) {
  ASSERT_EQ(RunTracked("whole").exit_code, 0);
  // Several parts, of which some don't get to their next checkpoint: the first ends after few
  // frames on any machine, and one of the others has the time for all.
  int parts = 0;
  for (bool done = false; !done && parts < 50; ++parts) {
    const std::string limit = "--time_limit_s=" + std::to_string(0.01 + 0.05 * parts);
    const ProgramResult result = RunTracked("out", {"--resume", limit});
    done = result.exit_code == 0;
    EXPECT_TRUE(done || result.exit_code == 4) << result.err;
  }
  EXPECT_GE(parts, 2);
  ExpectSameContents("whole", "out");
}

TEST_F(EdSlamStopTest, ResumeOfAFinishedRunChangesNothing) {
  ASSERT_EQ(RunTracked("whole").exit_code, 0);
  ASSERT_EQ(RunTracked("out").exit_code, 0);
  ASSERT_EQ(RunTracked("out", {"--resume"}).exit_code, 0);
  ExpectSameContents("whole", "out");
}

TEST_F(EdSlamStopTest, ResumeWithoutACheckpointStartsAnew) {
  const ProgramResult result = RunTracked("out", {"--resume", "--last=2"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("no " + (dir_ / "out/checkpoint.cbor") + " yet"));
  EXPECT_EQ(Frames().size(), 3u);
}

TEST_F(EdSlamStopTest, ResumeRefusesOtherFlagsOtherFramesAndDamage) {
  ASSERT_EQ(RunTracked("out").exit_code, 0);
  const std::string frames = ReadBytes(dir_ / "out/frames.csv");
  const ProgramResult flags = RunTracked("out", {"--resume", "--w_reg=0.5"});
  EXPECT_EQ(flags.exit_code, 1);
  EXPECT_THAT(flags.err, HasSubstr("--resume with --w_reg=0.5, expected --w_reg=0.1 as in "));

  const ProgramResult live = RunTracked("out", {"--resume", "--live_every=3"});
  EXPECT_EQ(live.exit_code, 1);
  EXPECT_THAT(live.err, HasSubstr("--live_every=3, expected --live_every="));

  const std::string last = Sequence() + "/depth/" + FrameName(19, "png");
  const std::string depth = ReadBytes(last);
  ASSERT_TRUE(WriteDepthImage(last, BumpyScene().RenderDepth(3), 50000.0).ok());
  const ProgramResult other = RunTracked("out", {"--resume"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("checkpoint.cbor: belongs to another sequence, expected "));
  WriteBytes(last, depth);

  const std::string checkpoint = ReadBytes(dir_ / "out/checkpoint.cbor");
  WriteBytes(dir_ / "out/checkpoint.cbor", checkpoint.substr(0, checkpoint.size() / 2));
  const ProgramResult damaged = RunTracked("out", {"--resume"});
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("checkpoint.cbor: is no checkpoint"));
  EXPECT_EQ(ReadBytes(dir_ / "out/frames.csv"), frames);

  WriteBytes(dir_ / "out/checkpoint.cbor", checkpoint);
  WriteBytes(dir_ / "out/frames.csv", "frame\n");
  const ProgramResult cut = RunTracked("out", {"--resume"});
  EXPECT_EQ(cut.exit_code, 2);
  EXPECT_THAT(cut.err, HasSubstr("frames.csv: has 6 bytes, expected the "));
}

TEST_F(EdSlamStopTest, ResumeTakesAnotherStrategyAndSaysSo) {
  ASSERT_EQ(RunTracked("out", {"--last=9"}).exit_code, 0);
  const std::string before = ReadBytes(dir_ / "out/frames.csv");
  const ProgramResult batch = RunTracked("out", {"--resume", "--mode=batch", "--verify_every=19"});
  EXPECT_EQ(batch.exit_code, 0);
  EXPECT_THAT(
      batch.err,
      HasSubstr("continued after frame 9 with --mode=batch, expected --mode=two_level for the "
                "same bytes as without the interruption"));
  const std::string after = ReadBytes(dir_ / "out/frames.csv");
  EXPECT_EQ(after.substr(0, before.size()), before);
  EXPECT_EQ(std::count(after.begin(), after.end(), '\n'), 25);
}

}  // namespace
}  // namespace ceres_ed
