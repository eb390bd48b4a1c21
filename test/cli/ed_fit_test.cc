// What ed_fit makes of good inputs.
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/io/warp_io.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(EdFitTest, PutsTheSourceOnTheTarget) {
  const ProgramResult result = FitPair();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, BackendComplaints());
  const PointCloud target = Load("target.ply").cloud;
  const double before = Summarize(SurfaceDistances(Load("source.ply").cloud.points, target)).max;
  const double after = Summarize(SurfaceDistances(Load("out.ply").cloud.points, target)).max;
  EXPECT_GT(before, 0.1);
  EXPECT_LT(after, kRingFacets);
}

TEST_F(EdFitTest, MakesTheFoldersOfItsOutputs) {
  const ProgramResult result = RunProgramFile(AppPath("ed_fit"),
                                              {dir_ / "source.ply",
                                               dir_ / "target.ply",
                                               "--output=" + (dir_ / "new/fitted/out.ply"),
                                               "--report=" + (dir_ / "new/report.json")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(dir_ / "new/fitted/out.ply"));
  EXPECT_TRUE(std::filesystem::exists(dir_ / "new/report.json"));
}

TEST_F(EdFitTest, KeepsQuadsOrderAndOtherProperties) {
  RingOptions rich;
  rich.quads = rich.extras = true;
  WritePair(rich, {});
  ASSERT_EQ(FitPair().exit_code, 0);
  const LoadedCloud source = Load("source.ply");
  const LoadedCloud fitted = Load("out.ply");
  EXPECT_EQ(fitted.document.comments, source.document.comments);
  for (const char* name : {"red", "label"}) {
    EXPECT_EQ(fitted.document.Find("vertex")->Find(name)->values,
              source.document.Find("vertex")->Find(name)->values);
  }
  const PlyProperty* faces = fitted.document.Find("face")->Find("vertex_indices");
  EXPECT_EQ(faces->list_sizes, std::vector<std::uint32_t>(24 * 12, 4));
  EXPECT_EQ(faces->values, source.document.Find("face")->Find("vertex_indices")->values);
}

TEST_F(EdFitTest, WarpsTheNormalsInTheFile) {
  RingOptions rich;
  rich.extras = true;
  WritePair(rich, {});
  ASSERT_EQ(FitPair().exit_code, 0);
  const PointCloud source = Load("source.ply").cloud;
  const PointCloud fitted = Load("out.ply").cloud;
  const std::vector<Eigen::Vector3d> expected = ComputeVertexNormals(fitted);
  const auto mean_angle = [&expected](const std::vector<Eigen::Vector3d>& normals) {
    double sum = 0.0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      EXPECT_NEAR(normals[i].norm(), 1.0, 1e-6);
      sum += std::acos(std::min(1.0, normals[i].dot(expected[i])));
    }
    return sum / static_cast<double>(normals.size());
  };
  // What is left is how coarse the mesh is.
  EXPECT_LT(mean_angle(fitted.normals), 0.5 * mean_angle(source.normals));
}

TEST_F(EdFitTest, WarpDoesThroughEdApplyWhatTheFitDid) {
  ASSERT_EQ(FitPair({"--warp=" + (dir_ / "warp.json")}).exit_code, 0);
  const auto apply = [this](const std::string& in) {
    return RunProgramFile(
        AppPath("ed_apply"),
        {dir_ / "warp.json", dir_ / in, "--output=" + (dir_ / ("applied_" + in))});
  };
  ASSERT_EQ(apply("source.ply").exit_code, 0);
  EXPECT_LT(LargestDistance(Load("applied_source.ply").cloud.points, Load("out.ply").cloud.points),
            1e-7 * kRingDiagonal);
  RingOptions dense;
  dense.columns = 96;
  dense.rows = 48;
  WriteBytes(dir_ / "dense.ply", RingPly(dense));
  ASSERT_EQ(apply("dense.ply").exit_code, 0);
  // Every fourth point of the dense ring is one of the source.
  const std::vector<Eigen::Vector3d> fine = Load("applied_dense.ply").cloud.points;
  ASSERT_EQ(fine.size(), 96u * 48u);
  const PointCloud target = Load("target.ply").cloud;
  EXPECT_LT(Summarize(SurfaceDistances(fine, target)).max, 2.0 * kRingFacets);
}

// A stray vertex in a triangle would be a short cut for distances along the surface.
TEST_F(EdFitTest, WarpDoesWhatTheFitDidWhereVerticesAreStray) {
  RingOptions source;
  source.more_vertices = {"900 0 0"};
  for (int v = 0; v < 6; ++v) {
    source.more_faces.push_back("3 " + std::to_string(v) + " " + std::to_string(v + 150) + " 288");
  }
  WritePair(source, {});
  const ProgramResult fit = FitPair({"--warp=" + (dir_ / "warp.json")});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  ASSERT_THAT(fit.err, HasSubstr("1 vertex far from all others left out"));
  ASSERT_EQ(RunProgramFile(
                AppPath("ed_apply"),
                {dir_ / "warp.json", dir_ / "source.ply", "--output=" + (dir_ / "applied.ply")})
                .exit_code,
            0);
  EXPECT_LT(LargestDistance(Load("applied.ply").cloud.points, Load("out.ply").cloud.points),
            1e-7 * kRingDiagonal);
}

// With one node for each point, a point between two nodes belongs to either of them.
TEST_F(EdFitTest, OneNodeForEachPointIsTheSameThroughEdApply) {
  for (const char* finish : {"--finish=true", "--finish=false"}) {
    ASSERT_EQ(FitPair({"--neighbors=1", "--warp=" + (dir_ / "w.json"), finish}).exit_code, 0);
    const ProgramResult applied = RunProgramFile(
        AppPath("ed_apply"),
        {dir_ / "w.json", dir_ / "source.ply", "--output=" + (dir_ / "applied.ply")});
    ASSERT_EQ(applied.exit_code, 0) << applied.err;
    EXPECT_LT(LargestDistance(Load("out.ply").cloud.points, Load("applied.ply").cloud.points),
              1e-6);
  }
}

TEST_F(EdFitTest, WritesTheGraphOfTheReport) {
  ASSERT_EQ(FitPair({"--graph=" + (dir_ / "graph.ply"),
                     "--warp=" + (dir_ / "warp.json"),
                     "--report=" + (dir_ / "report.json")})
                .exit_code,
            0);
  const nlohmann::json report = Report();
  const LoadedCloud graph = Load("graph.ply");
  EXPECT_EQ(graph.document.Find("vertex")->count, report["nodes"]["total"]);
  EXPECT_EQ(graph.document.Find("edge")->count, report["nodes"]["edges"]);
  const std::vector<double>& pr = graph.document.Find("vertex")->Find("pr")->values;
  EXPECT_EQ(std::count(pr.begin(), pr.end(), 1.0), report["nodes"]["pr"]);
  const StatusOr<Warp> warp = ReadWarp(dir_ / "warp.json");
  ASSERT_TRUE(warp.ok()) << warp.status().message();
  for (int j = 0; j < warp->graph.num_nodes(); ++j) {
    const Eigen::Vector3d moved =
        warp->graph.position(j) + Eigen::Vector3d(NodeTranslation(warp->state.node(j)));
    EXPECT_LT((graph.cloud.points[j] - warp->target_from_source * moved).norm(), 1e-6);
  }
}

TEST_F(EdFitTest, SolvesInTwoLevels) {
  for (const char* boundary : {"keep", "cut"}) {
    ASSERT_EQ(FitPair({"--mode=two_level",
                       "--rings=1",
                       "--boundary=" + std::string(boundary),
                       "--report=" + (dir_ / "report.json")})
                  .exit_code,
              0);
    EXPECT_EQ(Report()["mode"], "two_level");
    EXPECT_GT(Report()["time_s"]["level1"], 0.0);
    const PointCloud target = Load("target.ply").cloud;
    EXPECT_LT(Summarize(SurfaceDistances(Load("out.ply").cloud.points, target)).max,
              2.0 * kRingFacets);
  }
}

// Half of the target is gone, so that some nodes are PI.
TEST_F(EdFitTest, MarginalisesToWhatBatchFinds) {
  WriteHalfTarget();
  std::map<std::string, nlohmann::json> reports;
  std::map<std::string, std::vector<Eigen::Vector3d>> points;
  for (const std::string mode : {"batch", "marginal"}) {
    const ProgramResult result =
        FitPair({"--mode=" + mode, "--rings=0", "--report=" + (dir_ / "report.json")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    reports[mode] = Report();
    points[mode] = Load("out.ply").cloud.points;
  }
  const nlohmann::json& batch = reports["batch"];
  const nlohmann::json& marginal = reports["marginal"];
  EXPECT_EQ(marginal["mode"], "marginal");
  EXPECT_EQ(marginal["status"], batch["status"]);
  EXPECT_EQ(marginal["nodes"], batch["nodes"]);
  EXPECT_GT(marginal["nodes"]["pi"], 0);
  EXPECT_GT(marginal["time_s"]["level1"], 0.0);
  EXPECT_GT(marginal["time_s"]["level2"], 0.0);
  EXPECT_EQ(batch["time_s"]["level2"], 0.0);
  const double energy = batch["energy"]["final"];
  EXPECT_NEAR(marginal["energy"]["final"], energy, 1e-5 * energy);
  EXPECT_LT(LargestDistance(points["marginal"], points["batch"]), 2e-4 * kRingDiagonal);
}

TEST_F(EdFitTest, GivesTheSameBytesAtAnyThreadCountAndAgain) {
  for (const std::string mode : {"batch", "marginal"}) {
    if (mode == "marginal") WriteHalfTarget();
    std::map<std::string, std::string> first;
    for (const char* threads : {"1", "2", "1"}) {
      ASSERT_EQ(FitPair({"--warp=" + (dir_ / "warp.json"),
                         "--mode=" + mode,
                         std::string("--threads=") + threads})
                    .exit_code,
                0);
      for (const char* name : {"out.ply", "warp.json"}) {
        const std::string bytes = ReadBytes(dir_ / name);
        EXPECT_EQ(first.emplace(name, bytes).first->second, bytes)
            << mode << ", " << name << ", threads " << threads;
      }
    }
  }
}

TEST_F(EdFitTest, GivesTheSameInMillimetresAndMetres) {
  // Target points half way between two of the source would be rounded to either.
  RingOptions source;
  RingOptions target;
  target.phase = 0.004;
  WritePair(source, target);
  ASSERT_EQ(FitPair().exit_code, 0);
  std::vector<Eigen::Vector3d> metres = Load("out.ply").cloud.points;
  source.scale = 1000.0;
  target.scale = 1000.0;
  WritePair(source, target);
  // The last flag of a name wins.
  ASSERT_EQ(FitPair({"--node_spacing=200"}).exit_code, 0);
  std::vector<Eigen::Vector3d> millimetres = Load("out.ply").cloud.points;
  for (Eigen::Vector3d& point : millimetres) point /= 1000.0;
  EXPECT_LT(LargestDistance(metres, millimetres), 1e-6 * kRingDiagonal);
}

TEST_F(EdFitTest, MultipliesTheSourceByTheRatioOfUnits) {
  ASSERT_EQ(FitPair().exit_code, 0);
  const std::vector<Eigen::Vector3d> expected = Load("out.ply").cloud.points;
  RingOptions metres;
  metres.scale = 1e-3;
  WritePair(metres, {});
  const std::string spacing = "--node_spacing=0.0002";
  for (const char* scale : {"--scale=auto", "--scale=1000", "--scale=m:mm"}) {
    const ProgramResult result = FitPair({spacing, scale});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    // Rounding decides which of several equal places gets a node.
    EXPECT_LT(LargestDistance(Load("out.ply").cloud.points, expected), 0.03) << scale;
    EXPECT_NE(result.err.find("the source is multiplied by 1000"), std::string::npos);
  }
  // Without it the units are in the message.
  const ProgramResult refused = FitPair({spacing});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--scale=auto"), std::string::npos) << refused.err;
  // What is fixed keeps its place in the unit of the target.
  WriteBytes(dir_ / "fixed.txt", "0\n");
  ASSERT_EQ(FitPair({spacing, "--scale=1000", "--fixed=" + (dir_ / "fixed.txt")}).exit_code, 0);
  EXPECT_LT((Load("out.ply").cloud.points[0] - RingPoint(0.0, 0.0)).norm(), 1e-3);
}

TEST_F(EdFitTest, FitsASurfaceToItselfWithoutAComplaint) {
  const ProgramResult result =
      RunProgramFile(AppPath("ed_fit"),
                     {dir_ / "target.ply", dir_ / "target.ply", "--output=" + (dir_ / "out.ply")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, BackendComplaints());
  EXPECT_EQ(SplitLines(result.out).back(), "verdict    good");
}

TEST_F(EdFitTest, SaysNothingOfThreadsThatTheMachineLacks) {
  for (const char* solver : {"--linear_solver=block", "--linear_solver=ceres"}) {
    const ProgramResult result = FitPair({solver, "--threads=64", "--quiet"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err.find("num_threads"), std::string::npos) << result.err;
  }
}

TEST_F(EdFitTest, DoubtsWhatOneNodeDoes) {
  const ProgramResult result = FitPair({"--node_spacing=1e9"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("the graph has only 1 node"), std::string::npos) << result.err;
  EXPECT_EQ(SplitLines(result.out).back().find("verdict    good"), std::string::npos) << result.out;
}

TEST_F(EdFitTest, ShowsNoControlCharactersOfNames) {
  const std::string name = "red\x1b[31m.ply";
  const ProgramResult missing = RunProgramFile(
      AppPath("ed_fit"), {dir_ / name, dir_ / "target.ply", "--output=" + (dir_ / "out.ply")});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err.find('\x1b'), std::string::npos);
  EXPECT_NE(missing.err.find("red?[31m.ply"), std::string::npos) << missing.err;
  const ProgramResult written = FitPair({"--output=" + (dir_ / name)});
  EXPECT_EQ(written.exit_code, 0);
  EXPECT_EQ((written.out + written.err).find('\x1b'), std::string::npos);
  EXPECT_TRUE(Exists(name));
  const ProgramResult flag = RunProgramFile(AppPath("ed_fit"), {"--\x1b[2J"});
  EXPECT_EQ(flag.exit_code, 1);
  EXPECT_EQ(flag.err.find('\x1b'), std::string::npos);
}

TEST_F(EdFitTest, TakesBarePoints) {
  RingOptions bare;
  bare.faces = false;
  WritePair(bare, bare);
  ASSERT_EQ(FitPair().exit_code, 0);
  const LoadedCloud fitted = Load("out.ply");
  EXPECT_EQ(fitted.document.Find("face"), nullptr);
  RingOptions truth;
  truth.bent = true;
  WriteBytes(dir_ / "mesh.ply", RingPly(truth));
  EXPECT_LT(Summarize(SurfaceDistances(fitted.cloud.points, Load("mesh.ply").cloud)).max,
            2.0 * kRingFacets);
}

TEST_F(EdFitTest, KeepsIslandsAndIsolatedVertices) {
  RingOptions islands;
  islands.more_vertices = {"0 0 0.3", "-0.1 0 0", "0.1 0 0", "0 0.1 0"};
  islands.more_faces = {"3 289 290 291"};
  WritePair(islands, {});
  const ProgramResult result = FitPair();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const LoadedCloud fitted = Load("out.ply");
  EXPECT_EQ(fitted.cloud.size(), 24u * 12u + 4u);
  EXPECT_EQ(fitted.cloud.triangles.back(), (std::array<int, 3>{289, 290, 291}));
  // What lies apart follows the ring, which hardly moves there.
  const std::vector<Eigen::Vector3d> source = Load("source.ply").cloud.points;
  for (int i = 288; i < 292; ++i) EXPECT_LT((fitted.cloud.points[i] - source[i]).norm(), 0.1);
}

TEST_F(EdFitTest, WarnsOfVerticesThatAreNotFiniteAndKeepsTheirRows) {
  RingOptions holes;
  holes.is_nan = [](int i) { return i == 5 || i == 77; };
  WritePair(holes, {});
  const ProgramResult result = FitPair({"--report=" + (dir_ / "report.json")});
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, StartsWith("ed_fit: warning: " + (dir_ / "source.ply") + ": "));
  ASSERT_FALSE(Report()["warnings"].empty());
  EXPECT_THAT(result.err, HasSubstr(std::string(Report()["warnings"][0])));
  const LoadedCloud fitted = Load("out.ply");
  EXPECT_EQ(fitted.document.Find("vertex")->count, 24u * 12u);
  EXPECT_EQ(fitted.cloud.size(), 24u * 12u - 2u);
  EXPECT_TRUE(std::isnan(fitted.document.Find("vertex")->Find("x")->values[77]));
}

TEST_F(EdFitTest, LeavesOutVerticesThatWereNotMeasuredOrAreFarAway) {
  ASSERT_EQ(FitPair().exit_code, 0);
  const std::vector<Eigen::Vector3d> expected = Load("out.ply").cloud.points;
  RingOptions source;
  RingOptions target;
  source.more_vertices = {"0 0 0", "0 0 0"};
  target.more_vertices = {"900 0 0"};
  WritePair(source, target);
  const ProgramResult result = FitPair();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err,
              HasSubstr("source.ply: 2 vertices at 0 0 0 that were not measured left "
                        "out (first: vertex 288 at 0 0 0)"));
  EXPECT_THAT(result.err,
              HasSubstr("target.ply: 1 vertex far from all others left out (first: "
                        "vertex 527 at 900 0 0)"));
  const std::vector<Eigen::Vector3d> points = Load("out.ply").cloud.points;
  ASSERT_EQ(points.size(), expected.size() + 2);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(points[i], expected[i]) << i;
  EXPECT_EQ(points.back(), Eigen::Vector3d::Zero());
}

TEST_F(EdFitTest, AddsAnEnergyOfAPlugin) {
  const ProgramResult result = FitPair({std::string("--plugin=") + CERES_ED_GOOD_PLUGIN,
                                        "--energy=anchor:gain=3,weight=0.5;rotation:weight=2",
                                        "--report=" + (dir_ / "report.json")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json terms = Report()["energy"]["terms"];
  EXPECT_EQ(terms["anchor"]["residuals"], 3 * int(Report()["nodes"]["total"]));
  EXPECT_EQ(terms["rotation_2"]["residuals"], terms["rotation"]["residuals"]);
}

}  // namespace
}  // namespace ceres_ed
