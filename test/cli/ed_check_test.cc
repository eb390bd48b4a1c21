// ed_check as users run it, and what ed_fit says of the same faults.
#include <gmock/gmock.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class EdCheckTest : public EdFitTest {
 protected:
  ProgramResult Check(const std::vector<std::string>& flags = {}) const {
    std::vector<std::string> arguments = {dir_ / "source.ply", dir_ / "target.ply"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return RunProgramFile(AppPath("ed_check"), arguments);
  }
};

TEST_F(EdCheckTest, FindsNothingInAGoodPair) {
  const ProgramResult result = Check();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "no fault was found\n");
  EXPECT_EQ(result.err, "");
}

TEST_F(EdCheckTest, NamesFaultsWithTheirFixes) {
  RingOptions source;
  source.scale = 1e-3;
  source.more_faces = {"3 0 1 24", "3 1 24 0"};
  WritePair(source, {});
  const ProgramResult result = Check();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("triangles are there twice; use --repair, or delete them"));
  EXPECT_THAT(result.out, HasSubstr("use --scale=1000 or --scale=auto"));
  const nlohmann::json report = nlohmann::json::parse(Check({"--json"}).out);
  ASSERT_GE(report["checks"].size(), 2u);
  EXPECT_EQ(report["checks"][0]["code"], "duplicate_faces");
  EXPECT_EQ(report["checks"][0]["severity"], "warning");
  EXPECT_EQ(report["checks"][0]["value"], 2);
}

TEST_F(EdCheckTest, EndsWithTwoIfAFileCannotBeRead) {
  const ProgramResult result = RunProgramFile(AppPath("ed_check"), {dir_ / "missing.ply"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, StartsWith("ed_check: " + (dir_ / "missing.ply")));
}

TEST_F(EdCheckTest, FitWarnsAndRepairs) {
  RingOptions source;
  source.more_faces = {"3 0 1 24"};
  WritePair(source, {});
  const std::string report = "--report=" + (dir_ / "report.json");
  EXPECT_THAT(FitPair({report}).err, HasSubstr("1 of 577 triangles are there twice; use --repair"));
  EXPECT_EQ(Report()["checks"][0]["code"], "duplicate_faces");
  const ProgramResult repaired = FitPair({report, "--repair"});
  EXPECT_EQ(repaired.exit_code, 0);
  EXPECT_THAT(repaired.err, HasSubstr("1 triangles that are there twice left out"));
  EXPECT_TRUE(Report()["checks"].empty());
  // The file keeps its faces.
  EXPECT_EQ(Load("out.ply").document.Find("face")->count, 577u);
}

}  // namespace
}  // namespace ceres_ed
