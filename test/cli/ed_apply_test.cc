#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/run_program.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Tests run at once, so each process has a folder of its own.
std::string TempPath(const std::string& name) {
  static const TemporaryDirectory folder;
  return folder / name;
}

// Six nodes that all turn by 90 degrees about z and move by (1, 2, 3), so every point must too.
std::string WriteTurn(const std::string& path) {
  Warp warp;
  for (int j = 0; j < 6; ++j) warp.graph.AddNode({0.5 * j, 0.1 * j * j, 0.0});
  warp.state.Resize(6);
  Eigen::Matrix3d turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  for (int j = 0; j < 6; ++j) {
    const Eigen::Vector3d& g = warp.graph.position(j);
    MutableNodeAffine(warp.state.node(j)) = turn;
    MutableNodeTranslation(warp.state.node(j)) = turn * g + Eigen::Vector3d(1, 2, 3) - g;
  }
  warp.binding.distance = DistanceRule::kEuclidean;
  EXPECT_TRUE(WriteWarp(path, warp).ok());
  return path;
}

std::string WriteTriangle(const std::string& path) {
  std::ofstream(path) << "ply\nformat ascii 1.0\ncomment kept\nelement vertex 3\n"
                         "property double x\nproperty double y\nproperty double z\n"
                         "property int label\nelement face 1\n"
                         "property list uchar int vertex_indices\nend_header\n"
                         "0 0 0 7\n1 0 0 8\n0 2 0.5 9\n3 0 1 2\n";
  return path;
}

ProgramResult Apply(const std::vector<std::string>& arguments) {
  return RunProgramFile(AppPath("ed_apply"), arguments);
}

TEST(EdApply, WarnsOfACloudInAnotherUnit) {
  Warp warp;
  for (int j = 0; j < 12; ++j) warp.graph.AddNode({10.0 * j, 5.0 * (j % 3), 0.0});
  warp.state.Resize(12);
  warp.binding.distance = DistanceRule::kEuclidean;
  const std::string path = TempPath("millimetres.json");
  ASSERT_TRUE(WriteWarp(path, warp).ok());
  const ProgramResult result =
      Apply({path, WriteTriangle(TempPath("in.ply")), "--output=" + TempPath("out.ply")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("ed_apply: warning: "));
  EXPECT_THAT(result.err, HasSubstr("times as small as the graph of " + path));
}

TEST(EdApply, MovesEveryPointAndKeepsAllElse) {
  const std::string out = TempPath("out.ply");
  const ProgramResult result =
      Apply({WriteTurn(TempPath("w.json")), WriteTriangle(TempPath("in.ply")), "--output=" + out});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, out + ": 3 points deformed by 6 nodes\n");

  const StatusOr<LoadedCloud> loaded = LoadCloud(out);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  const std::vector<Eigen::Vector3d> expected = {{1, 2, 3}, {1, 3, 3}, {-1, 2, 3.5}};
  ASSERT_EQ(loaded->cloud.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT((loaded->cloud.points[i] - expected[i]).norm(), 1e-14) << "point " << i;
  }
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}};
  EXPECT_EQ(loaded->cloud.triangles, triangles);
  const PlyProperty* labels = loaded->document.Find("vertex")->Find("label");
  ASSERT_NE(labels, nullptr);
  EXPECT_EQ(labels->values, (std::vector<double>{7, 8, 9}));
}

TEST(EdApply, SaysWhatItLeavesOutAsEveryProgramDoes) {
  const std::string warp = WriteTurn(TempPath("w5.json"));
  const std::string cloud = WriteTriangle(TempPath("in5.ply"));
  std::string text;
  std::getline(std::ifstream(cloud), text, '\0');
  text.replace(text.find("3 0 1 2"), 7, "3 0 1 1");
  std::ofstream(cloud) << text;
  const ProgramResult result = Apply({warp, cloud, "--output=" + TempPath("out5.ply")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "ed_apply: warning: " + cloud + ": 1 triangle with a repeated corner dropped\n");
}

// A heart that is cut in two: the vertices along the cut are there twice, a little apart.
PointCloud TornHeart() {
  PointCloud heart = MakeSyntheticShape(SyntheticShape::kHeart, 1500, 1.0);
  const int whole = static_cast<int>(heart.size());
  for (std::array<int, 3>& triangle : heart.triangles) {
    if (heart.points[triangle[0]].x() < 0.0) continue;
    for (int& corner : triangle) {
      if (heart.points[corner].x() < 0.0) continue;
      if (corner >= whole) continue;
      heart.points.emplace_back(heart.points[corner].array() + 1e-8 * (corner % 5 + 1));
      corner = static_cast<int>(heart.size()) - 1;
    }
  }
  return heart;
}

TEST(EdApply, AgreesWithAFitThatHasMendedItsSource) {
  const PointCloud source = TornHeart();
  PointCloud target = MakeSyntheticShape(SyntheticShape::kHeart, 1500, 1.0);
  for (Eigen::Vector3d& point : target.points) point.z() += 0.3 * point.x() * point.x();
  const std::string torn = TempPath("torn.ply");
  const std::string bent = TempPath("bent.ply");
  CloudWriteOptions options;
  options.double_precision = true;
  ASSERT_TRUE(WriteCloud(torn, source, options).ok());
  ASSERT_TRUE(WriteCloud(bent, target, options).ok());
  const std::string warp = TempPath("mended.json");
  const std::string fitted = TempPath("fitted.ply");
  const ProgramResult fit =
      RunProgramFile(AppPath("ed_fit"),
                     {torn, bent, "--repair", "--output=" + fitted, "--warp=" + warp, "--quiet"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  ASSERT_THAT(fit.err, HasSubstr("moved to the place of the vertex")) << "nothing to mend";
  const std::string applied = TempPath("applied.ply");
  const ProgramResult result = Apply({warp, torn, "--output=" + applied});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("nearly coincide, as in the fit"));
  const StatusOr<LoadedCloud> one = LoadCloud(fitted);
  const StatusOr<LoadedCloud> other = LoadCloud(applied);
  ASSERT_TRUE(one.ok() && other.ok());
  ASSERT_EQ(one->cloud.size(), other->cloud.size());
  double apart = 0.0;
  for (std::size_t p = 0; p < one->cloud.size(); ++p) {
    apart = std::max(apart, (one->cloud.points[p] - other->cloud.points[p]).norm());
  }
  EXPECT_LT(apart, 1e-9);
}

TEST(EdApply, NeedsAnOutput) {
  const ProgramResult result = Apply({"w.json", "in.ply"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "ed_apply: flag --output is required; see --help\n");
}

TEST(EdApply, NamesTheInputThatIsBad) {
  const std::string warp = WriteTurn(TempPath("w2.json"));
  const std::string cloud = WriteTriangle(TempPath("in2.ply"));
  const std::string output = "--output=" + TempPath("never.ply");
  std::ofstream(TempPath("bad.json")) << "{";
  std::ofstream(TempPath("bad.ply")) << "ply\n";
  const std::vector<std::vector<std::string>> bad = {{"/nowhere/w.json", cloud},
                                                     {warp, "/nowhere/in.ply"},
                                                     {TempPath("bad.json"), cloud},
                                                     {warp, TempPath("bad.ply")}};
  for (const auto& arguments : bad) {
    const ProgramResult result = Apply({arguments[0], arguments[1], output});
    EXPECT_EQ(result.exit_code, 2);
    ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
    EXPECT_THAT(result.err, StartsWith("ed_apply: "));
    EXPECT_THAT(result.err, HasSubstr(arguments[0] == warp ? arguments[1] : arguments[0]));
    EXPECT_FALSE(std::ifstream(TempPath("never.ply")).good());
  }
}

TEST(EdApply, NamesAnOutputThatCannotBeWritten) {
  const std::string cloud = WriteTriangle(TempPath("in3.ply"));
  // A file is where a folder is needed.
  const ProgramResult result =
      Apply({WriteTurn(TempPath("w3.json")), cloud, "--output=" + cloud + "/out.ply"});
  EXPECT_EQ(result.exit_code, 2);
  ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
  EXPECT_THAT(result.err, HasSubstr(cloud + "/out.ply"));
}

TEST(EdApply, MakesTheFolderOfItsOutput) {
  const std::string folder = TempPath("new_folder");
  std::filesystem::remove_all(folder);
  const ProgramResult result = Apply({WriteTurn(TempPath("w4.json")),
                                      WriteTriangle(TempPath("in4.ply")),
                                      "--output=" + folder + "/deeper/out.ply"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder + "/deeper/out.ply"));
}

}  // namespace
}  // namespace ceres_ed
