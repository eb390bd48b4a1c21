#include <ceres_ed/report/html/cohort_page.h>

#include <limits>
#include <string>

#include <gmock/gmock.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

CohortPageRow Row(const std::string& name, const std::string& verdict) {
  CohortPageRow row;
  row.name = name;
  row.verdict = verdict;
  row.report = "members/" + name + "/report.html";
  row.thumbnail = "members/" + name + "/thumbnail.png";
  return row;
}

TEST(CohortPage, CountsVerdictsAndLinksReports) {
  CohortPageContent content;
  content.kind = "shapes";
  content.rows = {Row("a", "bad"), Row("b 1", "good"), Row("c", "good")};
  const std::string page = CohortPage(content);
  EXPECT_THAT(page, HasSubstr("<h1>3 shapes</h1>"));
  EXPECT_THAT(page, HasSubstr("2 good, 1 bad"));
  EXPECT_THAT(page, HasSubstr("href=\"./members/b%201/report.html\""));
  EXPECT_THAT(page, HasSubstr("src=\"./members/a/thumbnail.png\""));
  EXPECT_LT(page.find("members/a/"), page.find("members/c/"));
}

TEST(CohortPage, MakesTextsFromOutsideHarmless) {
  CohortPageContent content;
  CohortPageRow row = Row("a", "failed");
  row.group = "<b>\"x\"</b>";
  row.message = "<script>alert(1)</script>";
  row.report = "javascript:alert(1)";
  content.rows = {row};
  const std::string page = CohortPage(content);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_THAT(page, Not(HasSubstr("javascript:")));
}

TEST(CohortPage, FetchesNothingButPicturesBesideIt) {
  const std::string page = CohortPage({});
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("img-src data: 'self' file:"));
}

TEST(CohortPage, ShowsWhatIsUnknownAsADash) {
  CohortPageContent content;
  CohortPageRow row = Row("a", "good");
  row.landmark_rms = std::numeric_limits<double>::quiet_NaN();
  content.rows = {row};
  EXPECT_THAT(CohortPage(content), HasSubstr("data-key=\"\">-</td>"));
}

TEST(CohortPage, ShowsTheStatistics) {
  CohortPageContent content;
  content.statistics = {{"shapes", 3},
                        {"align", "rigid"},
                        {"components", {{"explained", {0.75, 0.25}}, {"total_variance", 2.0}}},
                        {"quality", {{"generalization", {0.2, 0.1}}, {"specificity", {0.1, 0.2}}}},
                        {"groups", {{"shapes", {{"old", 1}, {"young", 2}}}, {"permutations", 99}}},
                        {"rounds", {{{"round", 1}, {"change", 0.0125}}}}};
  const std::string page = CohortPage(content);
  for (const char* const text : {"Shape model", "Groups", "young", "Rounds", "1.25"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
}

}  // namespace
}  // namespace ceres_ed
