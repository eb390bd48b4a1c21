#include <ceres_ed/io/field/field_format.h>
#include <ceres_ed/io/field/grid_reader.h>

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

DisplacementField ObliqueField() {
  DisplacementField field;
  field.grid.size = {3, 2, 4};
  field.grid.spacing = {0.5, 0.25, 2.0};
  field.grid.origin = {-1.0, 7.0, 0.125};
  field.grid.direction =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  field.vectors.resize(3 * field.grid.num_points());
  return field;
}

TEST(GridReader, ReadsTheGridsOfOurOwnFields) {
  const TemporaryDirectory directory;
  DisplacementField field = ObliqueField();
  for (const bool is_mirrored : {false, true}) {
    if (is_mirrored) field.grid.direction.col(1) *= -1.0;
    for (const std::string ending : {".nrrd", ".nii", ".nii.gz", ".mha", ".mhd"}) {
      const std::string path = directory / ("field" + ending);
      ASSERT_TRUE((*FieldFormatOf(path))->write(path, field).ok());
      const StatusOr<FieldGrid> grid = ReadGrid(path);
      ASSERT_TRUE(grid.ok()) << grid.status().message();
      EXPECT_EQ(grid->size, field.grid.size) << ending;
      EXPECT_LT((grid->spacing - field.grid.spacing).norm(), 1e-6) << ending;
      EXPECT_LT((grid->origin - field.grid.origin).norm(), 1e-6) << ending;
      EXPECT_LT((grid->direction - field.grid.direction).norm(), 1e-6) << ending;
    }
  }
}

constexpr char kNrrd[] =
    "NRRD0004\ntype: short\ndimension: 3\nspace: RAS\nsizes: 4 5 6\n"
    "space directions: (0,2,0) (1,0,0) (0,0,3)\nspace origin: (10,20,30)\nencoding: raw\n\n";

TEST(GridReader, TurnsRightAnteriorSuperiorCoordinatesIntoItk) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "a.nrrd", kNrrd);
  const StatusOr<FieldGrid> grid = ReadGrid(directory / "a.nrrd");
  ASSERT_TRUE(grid.ok()) << grid.status().message();
  EXPECT_EQ(grid->Position(0, 0, 0), Eigen::Vector3d(-10, -20, 30));
  EXPECT_EQ(grid->Position(1, 0, 0), Eigen::Vector3d(-10, -22, 30));
  EXPECT_EQ(grid->Position(0, 1, 1), Eigen::Vector3d(-11, -20, 33));
}

TEST(GridReader, NamesWhatIsBad) {
  const TemporaryDirectory directory;
  const std::vector<std::array<std::string, 3>> changes = {
      {"space: RAS", "space: scanner-xyz", "'scanner-xyz', expected left-posterior-superior"},
      {"space: RAS\n", "", "'space' is missing"},
      {"sizes: 4 5 6", "sizes: 4 5", "'sizes' is '4 5', expected 3 numbers"},
      {"sizes: 4 5 6", "sizes: 4 0 6", "0 points along an axis"},
      {"sizes: 4 5 6", "sizes: 4 5.5 6", "5.5 points along an axis"},
      {"(0,2,0)", "(0,0,0)", "the spacing 0, expected"},
      {"(0,2,0)", "(0,nan,0)", "the spacing nan"},
      {"(0,2,0)", "(1,2,0)", "not at right angles"},
      {"(0,2,0) ", "", "expected 2 numbers"},
      {"(10,20,30)", "(10,x,30)", "expected 3 numbers"},
      {"(10,20,30)", "(10,inf,30)", "origin that is not finite"}};
  for (const auto& [from, to, message] : changes) {
    std::string text = kNrrd;
    text.replace(text.find(from), from.size(), to);
    WriteBytes(directory / "bad.nrrd", text);
    const StatusOr<FieldGrid> grid = ReadGrid(directory / "bad.nrrd");
    ASSERT_FALSE(grid.ok()) << to;
    EXPECT_THAT(grid.status().message(), ::testing::StartsWith(directory / "bad.nrrd")) << to;
    EXPECT_THAT(grid.status().message(), HasSubstr(message)) << to;
  }
}

TEST(GridReader, RefusesOtherFilesAndDamagedOnes) {
  const TemporaryDirectory directory;
  EXPECT_THAT(ReadGrid("image.png").status().message(), HasSubstr("expected a name that ends"));
  EXPECT_FALSE(ReadGrid(directory / "none.mha").ok());
  for (const std::string ending : {".nrrd", ".nii", ".nii.gz", ".mha"}) {
    const std::string path = directory / ("a" + ending);
    ASSERT_TRUE((*FieldFormatOf(path))->write(path, ObliqueField()).ok());
    const std::string bytes = ReadBytes(path);
    for (std::size_t size = 0; size < 200; size += 7) {
      WriteBytes(path, bytes.substr(0, size));
      // A header of text may be complete before its data.
      EXPECT_FALSE(ReadGrid(path).ok() && size < 100) << path << " " << size;
    }
    WriteBytes(path, std::string("\x1f\x8b\x08") + std::string(400, '\x55'));
    EXPECT_FALSE(ReadGrid(path).ok()) << path;
  }
}

}  // namespace
}  // namespace ceres_ed
