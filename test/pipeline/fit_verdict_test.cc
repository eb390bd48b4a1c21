#include "ceres_ed/pipeline/fit/fit_verdict.h"

#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A fit without a fault.
FitResult GoodFit() {
  FitResult result;
  result.status = SolveStatus::kConverged;
  for (int j = 0; j < 20; ++j) result.warp.graph.AddNode({0.05 * j, 0.0, 0.0});
  FitEvidence& evidence = result.evidence;
  evidence.measured = true;
  evidence.source = {0.97, 0.0, 0.03};
  evidence.target = {1.0, 0.0, 0.0};
  evidence.residual = 0.0005;
  evidence.edge_stretch = 0.1;
  evidence.node_stretch = 0.1;
  evidence.bend = 0.03;
  evidence.relief = 0.12;
  evidence.rigid_curvature = 0.05;
  evidence.disagreement = 0.004;
  return result;
}

Verdict Judge(const FitResult& result) { return JudgeFit({&result, 1.0, 1.0, 0.0}); }

TEST(FitVerdict, IsGoodWithoutAReason) {
  const Verdict verdict = Judge(GoodFit());
  EXPECT_EQ(verdict.grade, Grade::kGood);
  EXPECT_THAT(verdict.reasons, IsEmpty());
  EXPECT_EQ(verdict.Sentence(), "good");
}

TEST(FitVerdict, NamesEachFigureThatIsNotAsItShouldBe) {
  const struct {
    std::function<void(FitResult*)> change;
    const char* code;
    Grade grade;
  } cases[] = {
      {[](FitResult* r) {
         r->evidence.target = {0.73, 0.27, 0.0};
       },
       "target_unmatched",
       Grade::kDoubtful},
      {[](FitResult* r) {
         r->evidence.target = {0.5, 0.5, 0.0};
       },
       "target_unmatched",
       Grade::kBad},
      {[](FitResult* r) {
         r->evidence.source = {0.6, 0.1, 0.3};
       },
       "source_unmatched",
       Grade::kDoubtful},
      {[](FitResult* r) {
         r->evidence.source = {0.3, 0.0, 0.7};
       },
       "source_unseen",
       Grade::kDoubtful},
      {[](FitResult* r) { r->evidence.node_stretch = 0.5; }, "stretch", Grade::kDoubtful},
      {[](FitResult* r) { r->evidence.edge_stretch = 1.2; }, "edge_stretch", Grade::kBad},
      {[](FitResult* r) { r->evidence.folded = 0.01; }, "folds", Grade::kDoubtful},
      {[](FitResult* r) { r->evidence.disagreement = 0.05; }, "starts_disagree", Grade::kDoubtful},
      {[](FitResult* r) { r->evidence.relief = 0.06; }, "sliding", Grade::kDoubtful},
      {[](FitResult* r) { r->evidence.rigid_curvature = 0.0005; },
       "rigid_placement",
       Grade::kDoubtful},
      {[](FitResult* r) { r->evidence.residual = 0.006; }, "residual", Grade::kDoubtful},
      {[](FitResult* r) { r->evidence.noise = 0.01; }, "noise", Grade::kDoubtful},
      {[](FitResult* r) {
         r->warp.graph = DeformationGraph();
         r->warp.graph.AddNode({0.0, 0.0, 0.0});
       },
       "few_nodes",
       Grade::kDoubtful},
      {[](FitResult* r) { r->rigid_only = true; }, "rigid_only", Grade::kDoubtful},
      {[](FitResult* r) { r->status = SolveStatus::kTimeLimit; }, "stopped", Grade::kDoubtful},
  };
  for (const auto& c : cases) {
    FitResult result = GoodFit();
    c.change(&result);
    const Verdict verdict = Judge(result);
    EXPECT_EQ(verdict.grade, c.grade) << c.code;
    ASSERT_EQ(verdict.reasons.size(), 1u) << c.code;
    EXPECT_EQ(verdict.reasons[0].code, c.code);
    EXPECT_THAT(verdict.Sentence(), HasSubstr(verdict.reasons[0].text));
    EXPECT_EQ(verdict.advice.size(), 1u) << c.code;
  }
}

// A sheet that shows all of another one is larger on one side alone.
TEST(FitVerdict, DoubtsFlatSheetsThatLieBesideEachOther) {
  FitResult result = GoodFit();
  result.evidence.relief = 0.002;
  result.evidence.bend = 0.005;
  result.evidence.source = {0.98, 0.0, 0.02};
  EXPECT_EQ(Judge(result).grade, Grade::kGood);
  result.evidence.target = {0.97, 0.0, 0.03};
  EXPECT_EQ(Judge(result).grade, Grade::kDoubtful);
  EXPECT_THAT(Judge(result).Sentence(), HasSubstr("slid along it, by about 2 %"));
  // What overlaps only in part may have a relief that holds it.
  result.evidence.relief = 0.12;
  EXPECT_EQ(Judge(result).grade, Grade::kGood);
}

TEST(FitVerdict, AsksForTheUnitWhereTheSizesDiffer) {
  FitResult result = GoodFit();
  result.evidence.target = {0.73, 0.27, 0.0};
  EXPECT_THAT(Judge(result).Sentence(), HasSubstr("27 % of the target is not covered; are these"));
  EXPECT_THAT(JudgeFit({&result, 1.0, 10.0, 0.0}).Sentence(),
              HasSubstr("27 % of the target is not covered; are source and target in the same "
                        "unit? try --scale=auto"));
}

TEST(FitVerdict, JudgesAFitToLandmarksByTheirErrors) {
  FitResult result = GoodFit();
  result.evidence = FitEvidence();
  EXPECT_EQ(Judge(result).grade, Grade::kGood);
  const Verdict verdict = JudgeFit({&result, 2.0, 0.0, 0.1});
  EXPECT_EQ(verdict.grade, Grade::kDoubtful);
  EXPECT_EQ(verdict.reasons[0].code, "landmarks");
  EXPECT_DOUBLE_EQ(verdict.reasons[0].value, 0.05);
}

TEST(FitVerdict, IsBadIfTheFitFailed) {
  FitResult result = GoodFit();
  result.status = SolveStatus::kFailed;
  EXPECT_EQ(Judge(result).grade, Grade::kBad);
}

}  // namespace
}  // namespace ceres_ed
