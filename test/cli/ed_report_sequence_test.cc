// ed_report on a run of ed_slam, also where files of the run are missing or cut.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <test/cli/ed_slam_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class EdReportSequenceTest : public EdSlamTest {
 protected:
  EdReportSequenceTest() {
    WriteBumpySequence(Sequence(), 4);
    EXPECT_EQ(Run("out", {"--live_every=1", "--quiet"}).exit_code, 0);
  }

  ProgramResult Report() const {
    return RunProgramFile(AppPath("ed_report"), {dir_ / "out", "--html=" + (dir_ / "page.html")});
  }

  // Leaves the first part of a file.
  void Cut(const std::string& name, double part) const {
    const std::string bytes = ReadBytes(dir_ / name);
    WriteBytes(dir_ / name, bytes.substr(0, static_cast<std::size_t>(part * bytes.size())));
  }

  std::string Page() const { return ReadBytes(dir_ / "page.html"); }
};

TEST_F(EdReportSequenceTest, WritesThePageOfAFinishedRun) {
  const ProgramResult result = Report();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(Page(), HasSubstr("seq, 4 frames"));
  EXPECT_THAT(Page(), Not(HasSubstr("not shown: ")));
}

TEST_F(EdReportSequenceTest, SaysThatTheFramesAreCut) {
  WriteBytes(dir_ / "out/frames.csv", "frame,status,nodes\n0,initialized,4\n1,tra");
  const ProgramResult result = Report();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("The frames are not shown: "));
  EXPECT_THAT(result.err, HasSubstr("frames.csv"));
  EXPECT_THAT(Page(), HasSubstr("The frames are not shown: "));
}

TEST_F(EdReportSequenceTest, SaysThatTheTrajectoryIsMissing) {
  std::filesystem::remove(dir_ / "out/trajectory.txt");
  const ProgramResult result = Report();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("The path of the camera is not shown: "));
  // The figures of the frames are.
  EXPECT_THAT(Page(), HasSubstr("Figures of all 4 frames"));
}

TEST_F(EdReportSequenceTest, SaysThatTheTrajectoryIsOfOtherFrames) {
  Cut("out/trajectory.txt", 0.4);
  const ProgramResult result = Report();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("The path of the camera is not shown: "));
}

TEST_F(EdReportSequenceTest, ShowsTheOtherMomentsWhereALiveCloudIsCut) {
  Cut("out/live/000002.ply", 0.5);
  const ProgramResult result = Report();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("The live cloud is not shown: "));
  EXPECT_THAT(Page(), HasSubstr("The slider has 3 of the 4 frames"));
}

TEST_F(EdReportSequenceTest, ShowsLiveCloudsWithoutTheMapAtTheEnd) {
  std::filesystem::remove(dir_ / "out/map.ply");
  const ProgramResult result = Report();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("The map at its end is not shown: "));
  EXPECT_THAT(Page(), HasSubstr("The slider has 4 of the 4 frames"));
}

TEST_F(EdReportSequenceTest, IsWrittenWhereNothingButTheReportIsLeft) {
  for (const char* const name : {"frames.csv", "trajectory.txt", "map.ply", "live"}) {
    std::filesystem::remove_all(dir_ / ("out/" + std::string(name)));
  }
  const ProgramResult result = Report();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(Page(), HasSubstr("</html>"));
}

}  // namespace
}  // namespace ceres_ed
