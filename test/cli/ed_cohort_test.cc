// ed_cohort: what it writes, and what it says.
#include <ceres_ed/io/npy_file.h>

#include <gmock/gmock.h>
#include <test/cli/ed_cohort_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(EdCohortTest, WritesResultsOfEachShapeAndOfAll) {
  const ProgramResult result = Fit("out");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("4 run, 0 skipped as done, 0 failed"));
  for (const char* const file : {"fitted.ply", "points.npy", "report.json", "report.html"}) {
    EXPECT_TRUE(Exists(std::string("out/members/ring_2/") + file)) << file;
  }
  for (const char* const file : {"mean.ply",
                                 "aligned.npy",
                                 "components.npy",
                                 "scores.csv",
                                 "groups.ply",
                                 "summary.html",
                                 "component_01_plus.ply"}) {
    EXPECT_TRUE(Exists(std::string("out/") + file)) << file;
  }
  const StatusOr<NpyArray> all = ReadNpyFile(dir_ / "out/correspondences.npy");
  const StatusOr<NpyArray> one = ReadNpyFile(dir_ / "out/members/ring_2/points.npy");
  ASSERT_TRUE(all.ok() && one.ok());
  EXPECT_THAT(all->shape, ElementsAre(4, RingOptions().size(), 3));
  for (std::size_t i = 0; i < one->values.size(); ++i) {
    ASSERT_EQ(all->values[2 * one->values.size() + i], one->values[i]);
  }
  EXPECT_THAT(ReadBytes(dir_ / "out/summary.csv"), StartsWith("name,group,verdict,"));
  EXPECT_EQ(Json("out/statistics.json")["shapes"], 4);
}

TEST_F(EdCohortTest, EachFitIsThatOfEdFit) {
  ASSERT_EQ(Fit("out").exit_code, 0);
  const ProgramResult alone = RunProgramFile(
      AppPath("ed_fit"),
      {dir_ / "template.ply", dir_ / "ring_1.ply", "--output=" + (dir_ / "alone.ply")});
  ASSERT_EQ(alone.exit_code, 0);
  EXPECT_TRUE(ReadBytes(dir_ / "alone.ply") == ReadBytes(dir_ / "out/members/ring_1/fitted.ply"));
}

TEST_F(EdCohortTest, SummaryLinksPagesAndPictures) {
  ASSERT_EQ(Fit("out").exit_code, 0);
  const std::string page = ReadBytes(dir_ / "out/summary.html");
  EXPECT_THAT(page, HasSubstr("href=\"./members/ring_0/report.html\""));
  EXPECT_THAT(page, HasSubstr("Shape model"));
  if (Exists("out/members/ring_0/thumbnail.png")) {
    EXPECT_THAT(page, HasSubstr("src=\"./members/ring_0/thumbnail.png\""));
  }
}

TEST_F(EdCohortTest, AFailedShapeDoesNotStopTheRest) {
  WriteBytes(dir_ / "shapes.csv",
             "path,group\nring_0.ply,<b>\nnone.ply,\nring_1.ply,\nshapes.csv,x\n");
  const ProgramResult result = Fit("out");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("none.ply: cannot read"));
  EXPECT_THAT(result.err, HasSubstr("2 of 4 members have no result; see summary.csv"));
  EXPECT_TRUE(Exists("out/members/ring_1/fitted.ply"));
  EXPECT_FALSE(Exists("out/members/none/fitted.ply"));
  const std::vector<std::string> rows = SplitLines(ReadBytes(dir_ / "out/summary.csv"));
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_THAT(rows[1], StartsWith("none,,failed,"));
  EXPECT_EQ(Json("out/statistics.json")["shapes"], 2);
  EXPECT_THAT(ReadBytes(dir_ / "out/summary.html"), HasSubstr("&lt;b&gt;"));
}

TEST_F(EdCohortTest, FailIfLooksAtAllVerdicts) {
  WriteBytes(dir_ / "half.ply", RingPly([] {
               RingOptions ring;
               ring.is_kept = [](int column) { return column < 8; };
               ring.faces = true;
               return ring;
             }()));
  WriteBytes(dir_ / "dots.csv", "path\nring_0.ply\nshifted.ply\n");
  RingOptions small;
  small.columns = 8;
  small.rows = 3;
  small.scale = 0.3;
  WriteBytes(dir_ / "shifted.ply", RingPly(small));
  const auto run = [this](const std::string& fail_if) {
    return Cohort({dir_ / "template.ply",
                   "--manifest=" + (dir_ / "dots.csv"),
                   "--output=" + (dir_ / "out"),
                   "--fail_if=" + fail_if});
  };
  EXPECT_EQ(run("never").exit_code, 0);
  const ProgramResult result = run("bad");
  EXPECT_EQ(result.exit_code, 3) << ReadBytes(dir_ / "out/summary.csv");
  EXPECT_THAT(result.err, HasSubstr("1 of 2 members have no result, or a verdict"));
}

TEST_F(EdCohortTest, NamesUnitsOfOtherFiles) {
  RingOptions metres;
  metres.bent = true;
  metres.columns = 26;
  metres.phase = 0.3;
  metres.scale = 0.001;
  WriteBytes(dir_ / "metres.ply", RingPly(metres));
  WriteBytes(dir_ / "shapes.csv", "path,unit\nring_0.ply,mm\nmetres.ply,m\n");
  EXPECT_THAT(Fit("out").err, HasSubstr("row 1, ring_0: has the unit mm, expected --unit"));
  ASSERT_EQ(Fit("out", {"--unit=mm", "--align=rigid"}).exit_code, 0);
  const StatusOr<NpyArray> points = ReadNpyFile(dir_ / "out/members/metres/points.npy");
  ASSERT_TRUE(points.ok());
  const auto largest = std::max_element(points->values.begin(), points->values.end());
  // The ring reaches 0.77 mm to the side; in metres that would be 0.00077.
  EXPECT_GT(*largest, 0.5);
  EXPECT_LT(*largest, 1.5);
}

TEST_F(EdCohortTest, MeasuresLandmarks) {
  const Eigen::Vector3d a = RingPoint(0.0, 0.25);
  const Eigen::Vector3d b = RingPoint(0.25, 0.25);
  const Eigen::Vector3d c = RingPoint(0.6, 0.75);
  const auto rows = [](const std::vector<Eigen::Vector3d>& points) {
    std::string text;
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::ostringstream row;
      row << "p" << i << "," << points[i].x() << "," << points[i].y() << "," << points[i].z()
          << "\n";
      text += row.str();
    }
    return text;
  };
  WriteBytes(dir_ / "template_marks.csv", rows({a, b, c}));
  WriteBytes(dir_ / "ring_0_marks.csv", rows({BentPoint(a), BentPoint(b), BentPoint(c)}));
  WriteBytes(dir_ / "shapes.csv", "path,landmarks\nring_0.ply,ring_0_marks.csv\nring_1.ply,\n");
  EXPECT_THAT(Fit("out").err, HasSubstr("has landmarks, expected --source_landmarks"));
  const ProgramResult result =
      Fit("out", {"--source_landmarks=" + (dir_ / "template_marks.csv"), "--landmark_use=measure"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json record = Json("out/members/ring_0/record.json");
  EXPECT_EQ(record["landmarks"]["count"], 3);
  EXPECT_LT(record["landmarks"]["rms"], 0.05);
  EXPECT_EQ(Json("out/members/ring_1/record.json")["landmarks"]["count"], 0);
}

TEST_F(EdCohortTest, TheMeanBecomesTheTemplate) {
  const ProgramResult result = Fit("out", {"--iterate=2", "--pages=false"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json rounds = Json("out/statistics.json")["rounds"];
  ASSERT_EQ(rounds.size(), 2u);
  EXPECT_LT(rounds[1]["change"], 0.5 * rounds[0]["change"].get<double>());
  EXPECT_TRUE(Exists("out/rounds/2/mean.ply"));
  EXPECT_THAT(Fit("out", {"--iterate=2", "--pages=false"}).out,
              HasSubstr("0 run, 4 skipped as done"));
}

TEST_F(EdCohortTest, RunsPairsWithoutATemplate) {
  WriteBytes(dir_ / "pairs.csv", "source,target\nring_0.ply,ring_1.ply\ntemplate.ply,ring_2.ply\n");
  const ProgramResult result =
      Cohort({"--pairs=" + (dir_ / "pairs.csv"), "--output=" + (dir_ / "out")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(Exists("out/members/template_ring_2/fitted.ply"));
  EXPECT_TRUE(Exists("out/summary.csv"));
  EXPECT_FALSE(Exists("out/mean.ply"));
}

TEST_F(EdCohortTest, TracksSequences) {
  for (const char* const name : {"one", "two"}) {
    const ProgramResult made = RunProgramFile(AppPath("ed_simulate"),
                                              {"plane",
                                               "--output=" + (dir_ / "sequences") + "/" + name,
                                               "--frames=3",
                                               "--width=160",
                                               "--height=120",
                                               "--quiet"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  const ProgramResult result =
      Cohort({"--sequences=" + (dir_ / "sequences"), "--output=" + (dir_ / "out")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(Exists("out/members/two/tracked/map.ply"));
  EXPECT_THAT(Cohort({"--sequences=" + (dir_ / "sequences"), "--output=" + (dir_ / "out")}).out,
              HasSubstr("0 run, 2 skipped"));
}

TEST_F(EdCohortTest, SaysWhatItExpects) {
  const auto error = [this](const std::vector<std::string>& arguments) {
    const ProgramResult result = Cohort(arguments);
    EXPECT_EQ(result.exit_code, 1) << result.err;
    return result.err;
  };
  const std::string output = "--output=" + (dir_ / "out");
  const std::string manifest = "--manifest=" + (dir_ / "shapes.csv");
  EXPECT_THAT(error({"a.ply", manifest}), HasSubstr("--output is required"));
  EXPECT_THAT(error({"a.ply", output}), HasSubstr("0 of them are given, expected one"));
  EXPECT_THAT(error({manifest, output}), HasSubstr("no TEMPLATE"));
  EXPECT_THAT(error({"a.ply", "b.ply", manifest, output}), HasSubstr("a second argument"));
  EXPECT_THAT(error({"a.ply", manifest, output, "--shard=3/2"}), HasSubstr("expected i/n"));
  EXPECT_THAT(error({"a.ply", manifest, output, "--shard=1/2", "--iterate=1"}),
              HasSubstr("the mean needs all shapes"));
  EXPECT_THAT(error({"a.ply", "--pairs=x.csv", output}), HasSubstr("expected none with --pairs"));
  EXPECT_THAT(error({"--collect"}), HasSubstr("no folder is given"));
  EXPECT_THAT(error({"a.ply", manifest, output, "--unit=mile"}), HasSubstr("expected um, mm"));
}

TEST_F(EdCohortTest, NamesFilesThatCannotBeUsed) {
  const ProgramResult missing = Cohort(
      {dir_ / "none.ply", "--manifest=" + (dir_ / "shapes.csv"), "--output=" + (dir_ / "out")});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("none.ply"));
  const ProgramResult collected = Cohort({"--collect", dir_.path()});
  EXPECT_EQ(collected.exit_code, 2);
  EXPECT_THAT(collected.err, HasSubstr("cohort.json"));
}

}  // namespace
}  // namespace ceres_ed
