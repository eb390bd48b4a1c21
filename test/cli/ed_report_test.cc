// ed_report, and the pages and pictures of ed_eval.
#include <ceres_ed/report/picture/png.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

class EdReportTest : public EdFitTest {
 protected:
  EdReportTest() {
    EXPECT_EQ(FitPair({"--report=" + (dir_ / "report.json"),
                       "--warp=" + (dir_ / "warp.json"),
                       "--graph=" + (dir_ / "graph.ply"),
                       "--quiet"})
                  .exit_code,
              0);
  }

  ProgramResult RunReport(std::vector<std::string> arguments) const {
    return RunProgramFile(AppPath("ed_report"), arguments);
  }

  std::string Contents(const std::string& name) const {
    std::ifstream file(dir_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  bool PageHas(const std::string& text) const {
    return Contents("page.html").find(text) != std::string::npos;
  }

  const std::string html_ = "--html=" + (dir_ / "page.html");
};

TEST_F(EdReportTest, WritesPageAndPictureOfAFinishedFit) {
  if (!HasPictures()) GTEST_SKIP() << kNoPictures;
  const ProgramResult result =
      RunReport({dir_ / "report.json", html_, "--png=" + (dir_ / "page.png")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(PageHas("application/json") || PageHas("without three.js"));
  EXPECT_FALSE(PageHas("straight lines"));
  EXPECT_EQ(Contents("page.png").substr(1, 3), "PNG");
}

TEST_F(EdReportTest, ReadsTheReportOfAFolder) {
  EXPECT_EQ(RunReport({(dir_ / "report.json").substr(0, (dir_ / "report.json").rfind('/')), html_})
                .exit_code,
            0);
  EXPECT_TRUE(PageHas("</html>"));
}

TEST_F(EdReportTest, FindsTheFilesOfARunThatWasMoved) {
  const std::string moved = dir_ / "moved";
  std::filesystem::create_directory(moved);
  for (const char* const name :
       {"report.json", "source.ply", "target.ply", "out.ply", "warp.json", "graph.ply"}) {
    std::filesystem::rename(dir_ / name, moved + "/" + name);
  }
  const ProgramResult result = RunReport({moved, html_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
}

TEST_F(EdReportTest, SaysWhatIsMissingAndGoesOn) {
  std::filesystem::remove(dir_ / "target.ply");
  std::filesystem::remove(dir_ / "warp.json");
  ProgramResult result = RunReport({dir_ / "report.json", html_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("The target is not shown: "));
  EXPECT_TRUE(PageHas("The target is not shown: "));
  EXPECT_TRUE(PageHas("straight lines"));
  std::filesystem::remove(dir_ / "out.ply");
  result = RunReport({dir_ / "report.json", html_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(PageHas("There is nothing to show."));
  EXPECT_TRUE(PageHas("Energy of each term"));
  // There is no picture of nothing.
  result = RunReport({dir_ / "report.json", "--png=" + (dir_ / "page.png")});
  EXPECT_EQ(result.exit_code, 2);
}

TEST_F(EdReportTest, RefusesWhatIsNoReport) {
  WriteBytes(dir_ / "text.json", "{\"program\": ");
  WriteBytes(dir_ / "list.json", "[1, 2]");
  WriteBytes(dir_ / "slam.json", "{\"program\": \"other\"}");
  for (const auto& [name, sentence] : {std::pair("text.json", "no JSON"),
                                       std::pair("list.json", "has no \"program\""),
                                       std::pair("slam.json", "is of a run of 'other'"),
                                       std::pair("none.json", "cannot read")}) {
    const ProgramResult result = RunReport({dir_ / name, html_});
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_THAT(result.err, HasSubstr(std::string(name) + ": ")) << name;
    EXPECT_THAT(result.err, HasSubstr(sentence)) << name;
  }
}

TEST_F(EdReportTest, ADeeplyNestedReportIsRefused) {
  constexpr int kDepth = 200000;
  const std::string deep = std::string(kDepth, '[') + std::string(kDepth, ']');
  WriteBytes(
      dir_ / "deep.json",
      "{\"program\": \"ed_fit\", \"flags\": {\"a\": " + deep + "}, \"warnings\": [" + deep + "]}");
  const ProgramResult result = RunReport({dir_ / "deep.json", html_});
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("deep.json: byte "));
}

TEST_F(EdReportTest, FilesOfOtherPointsAreNotShown) {
  std::filesystem::copy_file(
      dir_ / "target.ply", dir_ / "source.ply", std::filesystem::copy_options::overwrite_existing);
  const ProgramResult result =
      RunReport({dir_ / "report.json", html_, "--truth=" + (dir_ / "graph.ply")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("truth"));
}

TEST_F(EdReportTest, ComparesSeveralRuns) {
  const ProgramResult result = RunReport({dir_ / "report.json", dir_ / "report.json", html_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(PageHas("2 runs compared"));
  EXPECT_TRUE(PageHas("All flags are equal."));
}

TEST_F(EdReportTest, TheSameRunHasTheSameBytes) {
  ASSERT_EQ(RunReport({dir_ / "report.json", html_}).exit_code, 0);
  const std::string first = Contents("page.html");
  ASSERT_EQ(RunReport({dir_ / "report.json", html_}).exit_code, 0);
  EXPECT_TRUE(first == Contents("page.html"));
}

TEST_F(EdReportTest, EvaluationsHavePagesToo) {
  if (!HasPictures()) GTEST_SKIP() << kNoPictures;
  const ProgramResult result = RunProgramFile(AppPath("ed_eval"),
                                              {dir_ / "out.ply",
                                               dir_ / "target.ply",
                                               "--source=" + (dir_ / "source.ply"),
                                               "--truth=" + (dir_ / "source.ply"),
                                               "--report=" + (dir_ / "eval.json"),
                                               html_,
                                               "--png=" + (dir_ / "eval.png")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(PageHas("distance to the true place"));
  EXPECT_EQ(Contents("eval.png").substr(1, 3), "PNG");
  EXPECT_EQ(RunReport({dir_ / "eval.json", html_}).exit_code, 0);
  EXPECT_TRUE(PageHas("distance to the true place"));
}

}  // namespace
}  // namespace ceres_ed
