#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/npy_rows.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(NpyRows, AreReadAsOneArray) {
  const TemporaryDirectory dir;
  const std::string path = dir / "rows.npy";
  auto writer = NpyRowsWriter::Create(path, {2, 2, 3});
  ASSERT_TRUE(writer.ok());
  const std::vector<double> second = {7, 8, 9, 10, 11, 12};
  const std::vector<double> first = {1, 2, 3, 4, 5, 6};
  ASSERT_TRUE((*writer)->Write(1, second.data()).ok());
  ASSERT_TRUE((*writer)->Write(0, first.data()).ok());
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_TRUE((*writer)->Commit().ok());
  const StatusOr<NpyArray> array = ReadNpyFile(path);
  ASSERT_TRUE(array.ok());
  EXPECT_THAT(array->shape, ElementsAre(2, 2, 3));
  EXPECT_THAT(array->values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
}

TEST(NpyRows, PartsOfRowsAreRead) {
  const TemporaryDirectory dir;
  ASSERT_TRUE(WriteNpyFile(dir / "a.npy", {{2, 3}, {1, 2, 3, 4, 5, 6}}).ok());
  const auto reader = NpyRowsReader::Open(dir / "a.npy");
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ((*reader)->row_size(), 3u);
  std::vector<double> values(2);
  ASSERT_TRUE((*reader)->Read(1, 1, 2, values.data()).ok());
  EXPECT_THAT(values, ElementsAre(5, 6));
}

TEST(NpyRows, NothingIsLeftOfAFileThatWasNotCompleted) {
  const TemporaryDirectory dir;
  { const auto writer = NpyRowsWriter::Create(dir / "rows.npy", {10, 3}); }
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

TEST(NpyRows, SayWhatIsWrongWithAFile) {
  const TemporaryDirectory dir;
  EXPECT_THAT(NpyRowsReader::Open(dir / "none.npy").status().message(), HasSubstr("cannot read"));
  ASSERT_TRUE(WriteNpyFileAsFloat(dir / "float.npy", {{1}, {1}}).ok());
  EXPECT_THAT(NpyRowsReader::Open(dir / "float.npy").status().message(), HasSubstr("float64"));
  ASSERT_TRUE(WriteNpyFile(dir / "cut.npy", {{4}, {1, 2, 3, 4}}).ok());
  std::filesystem::resize_file(dir / "cut.npy", std::filesystem::file_size(dir / "cut.npy") - 8);
  EXPECT_THAT(NpyRowsReader::Open(dir / "cut.npy").status().message(),
              HasSubstr("24 bytes of numbers, expected 32"));
  std::ofstream(dir / "text.npy") << "hello";
  EXPECT_FALSE(NpyRowsReader::Open(dir / "text.npy").ok());
}

}  // namespace
}  // namespace ceres_ed
