#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/warp_io.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/run_program.h>
#include <test/graph/warp_examples.h>
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

// A quarter turn about z that moves (x, y, z) to (4 - y, x - 1, z + 0.5).
std::string WriteTurn() {
  Similarity turn;
  turn.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitZ()));
  turn.translation = {4.0, -1.0, 0.5};
  Warp warp = MakeSimilarityWarp({});
  warp.target_from_source = turn;
  const std::string path = TempPath("turn.json");
  EXPECT_TRUE(WriteWarp(path, warp).ok());
  return path;
}

ProgramResult Apply(const std::vector<std::string>& arguments) {
  return RunProgramFile(AppPath("ed_apply"), arguments);
}

std::string Contents(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(EdApplyField, SaysGridSizeDirectionAndAxes) {
  const std::string path = TempPath("field.nii.gz");
  const ProgramResult result =
      Apply({WriteTurn(), "--field=" + path, "--spacing=0.5", "--margin=1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::vector<std::string> lines = SplitLines(result.out);
  ASSERT_EQ(lines.size(), 3u) << result.out;
  EXPECT_EQ(lines[0],
            path +
                ": forward (SOURCE to TARGET) field, 9 x 9 x 9 points, spacing 0.5, 0.00875 MB "
                "before compression");
  EXPECT_EQ(lines[1], "  axes: LPS in mm; the surfaces are taken for LPS in mm (--frame, --unit)");
  EXPECT_THAT(lines[2],
              StartsWith("  at 27 points of the surface the interpolated field is off by"));
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(EdApplyField, ReportsTheResidualOfAnInverse) {
  const std::string path = TempPath("inverse.vti");
  const ProgramResult result =
      Apply({WriteTurn(), "--field=" + path, "--spacing=0.5", "--inverse", "--frame=ras"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr(": inverse (TARGET to SOURCE) field, "));
  EXPECT_THAT(result.out, HasSubstr("axes: those of the surfaces"));
  EXPECT_THAT(result.out, HasSubstr("the warp has no inverse at 0 % of the grid"));
  EXPECT_THAT(Contents(path), HasSubstr("TARGET point + vector = SOURCE point (inverse)"));
}

TEST(EdApplyField, WritesThePlacementInBothDirections) {
  const std::string matrix = TempPath("rigid.txt");
  ProgramResult result = Apply({WriteTurn(), "--rigid=" + matrix});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, matrix + ": matrix that moves points of SOURCE to TARGET\n");
  std::istringstream numbers(Contents(matrix));
  const std::vector<double> expected = {0, -1, 0, 4, 1, 0, 0, -1, 0, 0, 1, 0.5, 0, 0, 0, 1};
  for (const double number : expected) {
    double read = -100.0;
    numbers >> read;
    EXPECT_NEAR(read, number, 1e-15);
  }
  const std::string itk = TempPath("rigid.tfm");
  result = Apply({WriteTurn(), "--rigid=" + itk});
  EXPECT_THAT(result.out, HasSubstr("maps points of TARGET to SOURCE, as ITK resamples; LPS, mm"));
  EXPECT_THAT(Contents(itk), StartsWith("#Insight Transform File V1.0\n"));
}

TEST(EdApplyField, KeepsTheLimitOnTheSize) {
  const std::string path = TempPath("large.nrrd");
  const ProgramResult result = Apply({WriteTurn(), "--field=" + path, "--spacing=0.001"});
  EXPECT_EQ(result.exit_code, 2);
  ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
  EXPECT_THAT(result.err, HasSubstr("expected at most 512 (--max_mb); --spacing="));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(EdApplyField, NamesWhatIsMissingOrWrong) {
  const std::string warp = WriteTurn();
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
      {{warp}, "flag --output is required"},
      {{warp, "--output=" + TempPath("x.ply")}, "without IN, expected what is to be deformed"},
      {{warp, "--field=" + TempPath("x.png")}, "unknown format of a displacement field"},
      {{warp, "--field=a.vti", "--rigid=a.vti"}, "'a.vti' is the name of two outputs"},
      {{warp, "--field=" + TempPath("x.vti"), "--spacing=-1"}, "--spacing=-1, expected"},
      {{warp, "--field=" + TempPath("x.vti"), "--bounds=1,2"}, "expected x0,x1,y0,y1,z0,z1"}};
  for (const auto& [arguments, message] : bad) {
    const ProgramResult result = Apply(arguments);
    EXPECT_EQ(result.exit_code, 1) << message;
    ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
  }
  const ProgramResult result =
      Apply({warp, "--field=" + TempPath("x.vti"), "--like=/nowhere/i.nrrd"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("/nowhere/i.nrrd"));
}

// A module that isn't there: the folder that is searched first has a broken one.
TEST(EdApplyField, SaysWhichPackageAnH5FileNeeds) {
  const std::string folder = TempPath("modules");
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/libceres_ed_hdf5.so." + CERES_ED_SOVERSION) << "no library";
  // Tests run one after the other. NOLINTNEXTLINE(concurrency-mt-unsafe)
  ASSERT_EQ(setenv("CERES_ED_MODULES", folder.c_str(), 1), 0);
  const ProgramResult result = Apply({WriteTurn(), "--field=" + TempPath("x.h5"), "--spacing=1"});
  // NOLINTNEXTLINE(concurrency-mt-unsafe)
  unsetenv("CERES_ED_MODULES");
  EXPECT_EQ(result.exit_code, 2);
  ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
  EXPECT_THAT(result.err, HasSubstr("install the package ceres-ed-hdf5, or libhdf5-dev"));
}

}  // namespace
}  // namespace ceres_ed
