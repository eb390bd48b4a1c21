// ed_cohort in several parts: shards, resumed runs, killed runs.
#include <ceres_ed/io/atomic_file.h>

#include <csignal>
#include <filesystem>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <test/cli/ed_cohort_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

TEST_F(EdCohortTest, SkipsWhatIsDoneWithTheSameInputsAndFlags) {
  ASSERT_EQ(Fit("out").exit_code, 0);
  EXPECT_THAT(Fit("out", {"--jobs=1", "--align=rigid"}).out, HasSubstr("0 run, 4 skipped as done"));
  // Another shape.
  WriteBytes(dir_ / "ring_1.ply", ReadBytes(dir_ / "ring_2.ply"));
  EXPECT_THAT(Fit("out").out, HasSubstr("1 run, 3 skipped as done"));
  // Another flag of the fits; another template.
  EXPECT_THAT(Fit("out", {"--w_reg=2"}).out, HasSubstr("4 run, 0 skipped as done"));
  WriteBytes(dir_ / "template.ply", ReadBytes(dir_ / "ring_3.ply"));
  EXPECT_THAT(Fit("out", {"--w_reg=2"}).out, HasSubstr("4 run, 0 skipped as done"));
  EXPECT_THAT(Fit("out", {"--w_reg=2", "--resume=false"}).out, HasSubstr("4 run, 0 skipped"));
}

TEST_F(EdCohortTest, RunsAgainWhatHasFailedIfAsked) {
  WriteBytes(dir_ / "shapes.csv", "path\nring_0.ply\nbad.ply\n");
  WriteBytes(dir_ / "bad.ply", "no mesh");
  EXPECT_EQ(Fit("out").exit_code, 3);
  const ProgramResult again = Fit("out");
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_THAT(again.out, HasSubstr("0 run, 2 skipped as done, 1 failed"));
  EXPECT_THAT(Fit("out", {"--retry_failed"}).out, HasSubstr("1 run, 1 skipped as done, 1 failed"));
}

TEST_F(EdCohortTest, ResultsDoNotDependOnJobs) {
  ASSERT_EQ(Fit("one", {"--jobs=1"}).exit_code, 0);
  ASSERT_EQ(Fit("three", {"--jobs=3", "--memory_mb=60"}).exit_code, 0);
  ExpectSameResults("one", "three");
}

TEST_F(EdCohortTest, ShardsJoinToTheBytesOfOneRun) {
  ASSERT_EQ(Fit("whole").exit_code, 0);
  for (const char* const shard : {"2/3", "1/3"}) {
    const ProgramResult result = Fit("parts", {std::string("--shard=") + shard});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  const ProgramResult early = Cohort({"--collect", dir_ / "parts"});
  EXPECT_EQ(early.exit_code, 3);
  EXPECT_THAT(early.out, HasSubstr("1 missing"));
  ASSERT_EQ(Fit("parts", {"--shard=3/3"}).exit_code, 0);
  ASSERT_EQ(Cohort({"--collect", dir_ / "parts"}).exit_code, 0);
  ExpectSameResults("whole", "parts");
}

TEST_F(EdCohortTest, ShardsInSeveralFoldersAreJoined) {
  ASSERT_EQ(Fit("whole").exit_code, 0);
  ASSERT_EQ(Fit("one", {"--shard=1/2"}).exit_code, 0);
  ASSERT_EQ(Fit("two", {"--shard=2/2"}).exit_code, 0);
  const ProgramResult result =
      Cohort({"--collect", dir_ / "one", dir_ / "two", "--output=" + (dir_ / "all")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* const name : {"correspondences.npy", "mean.ply", "scores.csv", "groups.ply"}) {
    EXPECT_TRUE(Results("all")[name] == Results("whole")[name]) << name;
  }
  EXPECT_THAT(ReadBytes(dir_ / "all/summary.html"),
              HasSubstr("./../two/members/ring_1/report.html"));
}

TEST_F(EdCohortTest, AKilledRunGoesOnToTheBytesOfAnUnbrokenOne) {
  ASSERT_EQ(Fit("whole").exit_code, 0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> moment(0.01, 0.5);
  for (int kill = 0; kill < 5; ++kill) {
    RunOptions options;
    options.signal = SIGKILL;
    options.signal_after_s = moment(random);
    Fit("broken", {}, options);
  }
  ASSERT_EQ(Fit("broken").exit_code, 0);
  ExpectSameResults("whole", "broken");
}

// As a process leaves it that is killed while it writes into the folder of the cohort itself.
TEST_F(EdCohortTest, HalfAFileOfAKilledRunIsRemoved) {
  ASSERT_EQ(Fit("whole").exit_code, 0);
  const std::string ending = TemporaryEnding();
  const std::string gone = ending.substr(0, ending.rfind('.') + 1) + std::to_string((1 << 22) + 1);
  std::filesystem::create_directories(dir_ / "broken");
  for (const char* const name : {"cohort.json", "correspondences.npy"}) {
    WriteBytes(dir_ / ("broken/" + (name + gone)), "half");
  }
  ASSERT_EQ(Fit("broken").exit_code, 0);
  ExpectSameResults("whole", "broken");
}

TEST_F(EdCohortTest, AnInterruptedRunSaysSoAndGoesOn) {
  std::string table = "name,path\n";
  for (int i = 0; i < 60; ++i) table += "copy_" + std::to_string(i) + ",ring_0.ply\n";
  WriteBytes(dir_ / "shapes.csv", table);
  RunOptions options;
  options.signal = SIGINT;
  options.signal_when = [this] { return Exists("out/members/copy_1/record.json"); };
  const ProgramResult result = Fit("out", {"--jobs=1"}, options);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_THAT(result.err, HasSubstr("of 60 members"));
  EXPECT_THAT(result.err, HasSubstr("the same command goes on from there"));
  EXPECT_TRUE(std::filesystem::is_empty(dir_ / "out/.work"));
}

}  // namespace
}  // namespace ceres_ed
