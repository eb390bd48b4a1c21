#include "ceres_ed/pipeline/slam/slam_verdict.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// 100 frames of a run without a fault.
std::vector<FrameRecord> GoodRun() {
  std::vector<FrameRecord> records(100);
  for (std::size_t k = 0; k < records.size(); ++k) {
    records[k].number = static_cast<int>(k);
    records[k].status = k == 0 ? "initialized" : "tracked";
    records[k]["overlap"] = 0.98;
    records[k]["explained"] = 0.95;
    records[k]["tentative"] = 0.05;
    records[k]["rms_plane"] = 0.0001;
  }
  return records;
}

constexpr double kNodeSpacing = 0.005;

TEST(SlamVerdict, IsGoodWithoutAReason) {
  const Verdict verdict = JudgeRun(GoodRun(), kNodeSpacing);
  EXPECT_EQ(verdict.grade, Grade::kGood);
  EXPECT_THAT(verdict.reasons, IsEmpty());
  EXPECT_EQ(verdict.Sentence(), "good");
}

TEST(SlamVerdict, GetsWorseWithTheLostFrames) {
  std::vector<FrameRecord> records = GoodRun();
  for (int k = 50; k < 55; ++k) records[k].status = "lost";
  Verdict verdict = JudgeRun(records, kNodeSpacing);
  EXPECT_EQ(verdict.grade, Grade::kDoubtful);
  ASSERT_EQ(verdict.reasons.size(), 1u);
  EXPECT_EQ(verdict.reasons[0].code, "lost_frames");
  EXPECT_DOUBLE_EQ(verdict.reasons[0].value, 0.05);
  EXPECT_DOUBLE_EQ(verdict.reasons[0].bound, 0.02);
  EXPECT_THAT(verdict.reasons[0].text, HasSubstr("5 of 100 frames"));
  EXPECT_EQ(verdict.advice.size(), 1u);
  for (int k = 20; k < 100; ++k) records[k].status = "lost";
  EXPECT_EQ(JudgeRun(records, kNodeSpacing).grade, Grade::kBad);
}

TEST(SlamVerdict, IsBadIfNothingWasTracked) {
  std::vector<FrameRecord> records = GoodRun();
  for (std::size_t k = 1; k < records.size(); ++k) records[k].status = "lost";
  const Verdict verdict = JudgeRun(records, kNodeSpacing);
  EXPECT_EQ(verdict.grade, Grade::kBad);
  EXPECT_EQ(verdict.reasons[0].code, "nothing_tracked");
  // One frame alone is no failure.
  records.resize(1);
  EXPECT_EQ(JudgeRun(records, kNodeSpacing).grade, Grade::kGood);
}

TEST(SlamVerdict, NamesEachFigureThatIsNotAsItShouldBe) {
  const struct {
    const char* column;
    double value;
    const char* code;
  } cases[] = {{"overlap", 0.8, "overlap"},
               {"explained", 0.5, "explained"},
               {"rms_plane", 0.15 * kNodeSpacing, "residual"},
               {"weak_directions", 1.0, "weak_directions"},
               {"tentative", 0.4, "tentative_points"}};
  for (const auto& c : cases) {
    std::vector<FrameRecord> records = GoodRun();
    for (FrameRecord& record : records) record[c.column] = c.value;
    const Verdict verdict = JudgeRun(records, kNodeSpacing);
    EXPECT_EQ(verdict.grade, Grade::kDoubtful) << c.column;
    ASSERT_EQ(verdict.reasons.size(), 1u) << c.column;
    EXPECT_EQ(verdict.reasons[0].code, c.code);
    EXPECT_THAT(verdict.Sentence(), HasSubstr(verdict.reasons[0].text));
  }
}

TEST(SlamVerdict, ReportHasTheFieldsThatScriptsRead) {
  std::vector<FrameRecord> records = GoodRun();
  for (FrameRecord& record : records) record["overlap"] = 0.5;
  const nlohmann::ordered_json report = VerdictReport(JudgeRun(records, kNodeSpacing));
  EXPECT_EQ(report["grade"], "bad");
  EXPECT_EQ(report["reasons"][0]["code"], "overlap");
  EXPECT_EQ(report["reasons"][0]["value"], 0.5);
  EXPECT_EQ(report["reasons"][0]["bound"], 0.85);
  EXPECT_TRUE(report["reasons"][0]["text"].is_string());
  EXPECT_TRUE(report["advice"][0].is_string());
}

}  // namespace
}  // namespace ceres_ed
