// ed_fit that does not get to its end: Ctrl-C, a time limit, a kill.
#include <ceres_ed/util/timer.h>

#include <csignal>
#include <random>

#include <gmock/gmock.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

// A fit that takes seconds.
class EdFitStopTest : public EdFitTest {
 protected:
  ProgramResult FitDolphin(const std::vector<std::string>& flags,
                           const RunOptions& options = {}) const {
    const std::string pair = std::string(CERES_ED_SOURCE_DIR) + "/data/dolphin_bend/";
    std::vector<std::string> arguments = {pair + "source.ply",
                                          pair + "target.ply",
                                          "--node_spacing=0.015",
                                          "--output=" + (dir_ / "out.ply"),
                                          "--warp=" + (dir_ / "warp.json"),
                                          "--report=" + (dir_ / "report.json")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return RunProgramFile(AppPath("ed_fit"), arguments, options);
  }

  void ExpectResultSoFar(const ProgramResult& result, const std::string& status) const {
    EXPECT_EQ(result.exit_code, 4) << result.err;
    ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
    EXPECT_THAT(result.err, HasSubstr("out.ply"));
    EXPECT_EQ(Report()["status"], status);
    EXPECT_TRUE(Exists("warp.json"));
    // More than half of the points must be finite to be loaded at all; here all are.
    EXPECT_EQ(Load("out.ply").cloud.size(), 2924u);
    EXPECT_TRUE(Load("out.ply").warnings.empty());
  }
};

TEST_F(EdFitStopTest, InterruptWritesTheBestSoFar) {
  for (const int signal : {SIGINT, SIGTERM}) {
    RunOptions options;
    options.signal = signal;
    options.signal_after_s = 0.4;
    ExpectResultSoFar(FitDolphin({}, options), "interrupted");
  }
}

TEST_F(EdFitStopTest, TimeLimitWritesTheBestSoFar) {
  for (const char* limit : {"1e-6", "0.3"}) {
    const ProgramResult result = FitDolphin({std::string("--time_limit_s=") + limit});
    ExpectResultSoFar(result, "time_limit");
    EXPECT_LT(Report()["time_s"]["total"], 3.0);
  }
}

// Reading a large mesh may take longer than the limit; the checks of it are then left out.
TEST_F(EdFitStopTest, NoInputIsCheckedAfterTheTimeLimit) {
  RingOptions ring;
  ring.more_faces = {"3 0 1 25", "3 0 1 25"};
  WriteBytes(dir_ / "twice.ply", RingPly(ring));
  const auto checks = [this](const std::vector<std::string>& flags) {
    std::vector<std::string> arguments = {dir_ / "twice.ply",
                                          dir_ / "twice.ply",
                                          "--output=" + (dir_ / "out.ply"),
                                          "--report=" + (dir_ / "report.json")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    RunProgramFile(AppPath("ed_fit"), arguments, {});
    return Report()["checks"].size();
  };
  EXPECT_GT(checks({}), 0u);
  EXPECT_EQ(checks({"--time_limit_s=1e-6"}), 0u);
}

TEST_F(EdFitStopTest, AKilledRunLeavesTheOldFileOrTheNewOne) {
  ASSERT_EQ(FitPair({"--warp=" + (dir_ / "warp.json")}).exit_code, 0);
  const std::string new_cloud = ReadBytes(dir_ / "out.ply");
  const std::string new_warp = ReadBytes(dir_ / "warp.json");
  const Timer timer;
  ASSERT_EQ(FitPair({"--warp=" + (dir_ / "warp.json")}).exit_code, 0);
  const double duration = timer.Seconds();

  std::mt19937 random(7);
  // Half of the kills fall on the last tenth, where files are written.
  std::uniform_real_distribution<double> whole(0.0, duration);
  std::uniform_real_distribution<double> end(0.9 * duration, 1.05 * duration);
  int killed = 0;
  for (int run = 0; run < 24; ++run) {
    WriteBytes(dir_ / "out.ply", "old");
    WriteBytes(dir_ / "warp.json", "old");
    RunOptions options;
    options.signal = SIGKILL;
    options.signal_after_s = run % 2 == 0 ? whole(random) : end(random);
    if (FitPair({"--warp=" + (dir_ / "warp.json")}, options).signal == SIGKILL) ++killed;
    const std::string cloud = ReadBytes(dir_ / "out.ply");
    const std::string warp = ReadBytes(dir_ / "warp.json");
    EXPECT_TRUE(cloud == "old" || cloud == new_cloud) << "killed at " << options.signal_after_s;
    EXPECT_TRUE(warp == "old" || warp == new_warp) << "killed at " << options.signal_after_s;
  }
  EXPECT_GE(killed, 8);
}

}  // namespace
}  // namespace ceres_ed
