// What ed_fit says: the summary, and every field of report.json.
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/simulation/views.h>

#include <gmock/gmock.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::StartsWith;

TEST_F(EdFitTest, SumsUpOnStdoutUnlessQuiet) {
  const std::vector<std::string> lines = SplitLines(FitPair().out);
  ASSERT_EQ(lines.size(), 7u);
  const char* names[] = {"status     ", "nodes      ", "inliers    ", "rms        ", "time       "};
  for (int i = 0; i < 5; ++i) EXPECT_THAT(lines[i], StartsWith(names[i]));
  EXPECT_THAT(lines[0], StartsWith("status     done: "));
  EXPECT_EQ(lines[5], "output     " + (dir_ / "out.ply"));
  EXPECT_EQ(lines[6], "verdict    good");
  const ProgramResult quiet = FitPair({"--quiet"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, BackendComplaints());
}

TEST_F(EdFitTest, JudgesARingOnAnotherBody) {
  // The target is a thin rod.
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 600\nproperty double x\nproperty double "
      "y\nproperty double z\nend_header\n";
  for (int i = 0; i < 600; ++i) {
    const double a = 2.4 * i;
    text += std::to_string(2.0 * i / 600.0) + ' ' + std::to_string(0.05 * std::cos(a)) + ' ' +
            std::to_string(0.05 * std::sin(a)) + '\n';
  }
  WriteBytes(dir_ / "target.ply", text);
  const std::string report = "--report=" + (dir_ / "report.json");
  ProgramResult result = FitPair({report});
  EXPECT_EQ(result.exit_code, 0);
  const nlohmann::json verdict = Report()["verdict"];
  EXPECT_NE(verdict["grade"], "good");
  ASSERT_FALSE(verdict["reasons"].empty());
  EXPECT_TRUE(verdict["reasons"][0]["text"].is_string());
  EXPECT_FALSE(verdict["advice"].empty());
  EXPECT_THAT(SplitLines(result.out).back(),
              StartsWith("verdict    " + verdict["grade"].get<std::string>() + ": "));
  // The exit code says so where it is asked for, and the outputs are written.
  result = FitPair({"--fail_if=doubtful", "--output=" + (dir_ / "failed.ply")});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, ::testing::HasSubstr("failed.ply: the verdict is "));
  EXPECT_TRUE(Exists("failed.ply"));
}

TEST_F(EdFitTest, ReportsTheActiveSet) {
  const std::string report = "--report=" + (dir_ / "report.json");
  ASSERT_EQ(FitPair({report}).exit_code, 0);
  EXPECT_TRUE(Report()["active_set"].is_null());
  ASSERT_EQ(FitPair({report, "--mode=two_level"}).exit_code, 0);
  EXPECT_EQ(Report()["active_set"]["rule"], "rings");
  EXPECT_TRUE(Report()["active_set"]["bound"].is_null());
  ASSERT_EQ(FitPair({report, "--mode=two_level", "--active=information", "--active_bound=0.001"})
                .exit_code,
            0);
  const nlohmann::json set = Report()["active_set"];
  EXPECT_EQ(set["rule"], "information");
  EXPECT_EQ(set["bound"], 0.001);
  EXPECT_LE(set["pi"], Report()["nodes"]["pi"]);
  EXPECT_GE(set["information_lost"], 0.0);
}

TEST_F(EdFitTest, ReportsEveryFieldWithItsType) {
  ASSERT_EQ(FitPair({"--report=" + (dir_ / "report.json")}).exit_code, 0);
  const nlohmann::json report = Report();
  const auto expect = [&report](bool (nlohmann::json::*is_type)() const noexcept,
                                const std::vector<std::string>& fields) {
    for (const std::string& field : fields) {
      const nlohmann::json::json_pointer pointer("/" + field);
      ASSERT_TRUE(report.contains(pointer)) << field;
      EXPECT_TRUE((report[pointer].*is_type)()) << field << " is " << report[pointer];
    }
  };
  using Json = nlohmann::json;
  expect(&Json::is_string,
         {"program",
          "version",
          "mode",
          "verdict/grade",
          "status",
          "message",
          "source/path",
          "target/path",
          "backend/ceres",
          "backend/sparse_library",
          "backend/ordering_library",
          "backend/blas",
          "backend/kernels",
          "flags/output",
          "flags/loss"});
  expect(&Json::is_number_integer,
         {"source/points",
          "source/faces",
          "target/points",
          "target/faces",
          "nodes/total",
          "nodes/pr",
          "nodes/pi",
          "nodes/edges",
          "inliers",
          "outer_iterations",
          "solver_iterations",
          "energy/terms/rotation/residuals",
          "threads",
          "flags/rings"});
  expect(&Json::is_number,
         {"source/diagonal",
          "target/diagonal",
          "unmatched/source",
          "unmatched/target",
          "evidence/residual",
          "energy/initial",
          "energy/final",
          "energy/terms/rotation/weighted",
          "energy/terms/regularization/raw",
          "energy/terms/point_to_plane/raw",
          "rms/point_to_plane",
          "rms/point_to_point",
          "noise",
          "rigid/rotation_deg",
          "rigid/translation/2",
          "rigid/scale",
          "displacement/mean",
          "displacement/max",
          "time_s/total",
          "time_s/load",
          "time_s/graph",
          "time_s/associate",
          "time_s/build",
          "time_s/solve",
          "time_s/level1",
          "time_s/level2",
          "time_s/write",
          "flags/node_spacing"});
  expect(&Json::is_array, {"warnings", "rigid/translation"});
  expect(&Json::is_boolean, {"flags/rigid_first", "flags/quiet"});
}

TEST_F(EdFitTest, ReportsFiguresThatAgreeWithTheFiles) {
  ASSERT_EQ(FitPair({"--report=" + (dir_ / "report.json")}).exit_code, 0);
  const nlohmann::json report = Report();
  EXPECT_EQ(report["program"], "ed_fit");
  EXPECT_EQ(report["mode"], "batch");
  EXPECT_EQ(report["source"]["points"], 24 * 12);
  EXPECT_EQ(report["source"]["faces"], 2 * 24 * 12);
  const LoadedCloud source = Load("source.ply");
  const LoadedCloud fitted = Load("out.ply");
  EXPECT_NEAR(report["source"]["diagonal"], Diagonal(source.cloud.points), 1e-12);
  const double moved = LargestDistance(source.cloud.points, fitted.cloud.points);
  EXPECT_NEAR(report["displacement"]["max"], moved, 1e-12);
  EXPECT_EQ(report["nodes"]["total"], int(report["nodes"]["pr"]) + int(report["nodes"]["pi"]));
  double sum = 0.0;
  for (const auto& term : report["energy"]["terms"]) sum += double(term["weighted"]);
  EXPECT_NEAR(report["energy"]["final"], sum, 1e-9 * sum);
  EXPECT_LT(report["energy"]["final"], report["energy"]["initial"]);
  EXPECT_GT(report["rms"]["point_to_plane"], 0.0);
  EXPECT_LT(report["rms"]["point_to_plane"], kRingFacets);
  EXPECT_GT(report["time_s"]["total"], report["time_s"]["solve"]);
}

TEST_F(EdFitTest, ReportsTheEnergyOfEveryRound) {
  ASSERT_EQ(FitPair({"--report=" + (dir_ / "report.json")}).exit_code, 0);
  const nlohmann::json energy = Report()["energy"];
  ASSERT_GT(energy["rounds"].size(), 1U);
  for (const nlohmann::json& round : energy["rounds"]) {
    EXPECT_GT(round["inliers"], 0);
    EXPECT_GT(double(round["stiffness"]), 0.999 * double(Report()["flags"]["final_stiffness"]));
    double sum = 0.0;
    for (const auto& term : round["terms"]) sum += double(term);
    EXPECT_NEAR(round["total"], sum, 1e-9 * sum);
  }
  // The weights are those of the end.
  EXPECT_NEAR(energy["rounds"].back()["total"], energy["final"], 1e-9 * double(energy["final"]));
}

TEST_F(EdFitTest, ReportsACommandThatRepeatsTheRun) {
  const std::string report = "--report=" + (dir_ / "report.json");
  ASSERT_EQ(FitPair({report, "--node_spacing=0.3"}).exit_code, 0);
  const nlohmann::json given = Report()["flags_given"];
  EXPECT_EQ(given, nlohmann::json({"node_spacing", "output", "report"}));
  const std::string command = Report()["command"];
  EXPECT_THAT(command, StartsWith("ed_fit "));
  EXPECT_THAT(command, ::testing::HasSubstr(" --node_spacing=0.3"));
}

TEST_F(EdFitTest, WritesAPageOfTheFit) {
  const std::string html = "--html=" + (dir_ / "fit.html");
  ASSERT_EQ(FitPair({html}).exit_code, 0);
  std::ifstream file(dir_ / "fit.html");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(page.find("<title>") != std::string::npos);
  EXPECT_TRUE(page.find("Good: nothing speaks against this result.") != std::string::npos);
  EXPECT_LT(page.size(), 15U << 20U);
  // That a page can't be written is said before the fit.
  const ProgramResult failed = FitPair({"--html=/dev/null/fit.html"});
  EXPECT_EQ(failed.exit_code, 2);
  EXPECT_THAT(failed.err, ::testing::HasSubstr("/dev/null/fit.html"));
}

TEST_F(EdFitTest, ReportsTheNoiseOfTheTarget) {
  RingOptions dense;
  dense.columns = 72;
  dense.rows = 36;
  WriteBytes(dir_ / "source.ply", RingPly(dense));
  LoadedCloud target = Load("source.ply");
  AddSyntheticNoise(0.01, 9, &target.cloud);
  const std::vector<Eigen::Vector3d> noisy = target.cloud.points;
  ASSERT_TRUE(SaveCloud(dir_ / "target.ply", target, noisy, nullptr).ok());
  ASSERT_EQ(FitPair({"--report=" + (dir_ / "report.json")}).exit_code, 0);
  EXPECT_NEAR(double(Report()["noise"]), 0.01, 0.15 * 0.01);
}

}  // namespace
}  // namespace ceres_ed
