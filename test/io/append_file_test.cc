#include "ceres_ed/io/append_file.h"

#include <filesystem>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

TEST(AppendFile, HasEachRowAtOnce) {
  const TemporaryDirectory dir;
  StatusOr<AppendFile> file = AppendFile::Create(dir / "rows.csv");
  ASSERT_TRUE(file.ok());
  ASSERT_TRUE(file->Append("a,b\n").ok());
  // The file is neither closed nor flushed, as if the program had been killed.
  EXPECT_EQ(ReadBytes(dir / "rows.csv"), "a,b\n");
  AppendFile moved = *std::move(file);
  ASSERT_TRUE(moved.Append("1,2\n").ok());
  EXPECT_EQ(ReadBytes(dir / "rows.csv"), "a,b\n1,2\n");
  EXPECT_EQ(moved.size(), 8);
}

TEST(AppendFile, CreateEmptiesAnOldFile) {
  const TemporaryDirectory dir;
  WriteBytes(dir / "rows.csv", "old");
  ASSERT_TRUE(AppendFile::Create(dir / "rows.csv").ok());
  EXPECT_EQ(ReadBytes(dir / "rows.csv"), "");
}

TEST(AppendFile, CreateDoesNotWriteThroughALinkToAFile) {
  const TemporaryDirectory dir;
  WriteBytes(dir / "other.csv", "kept");
  std::filesystem::create_symlink(dir / "other.csv", dir / "rows.csv");
  std::filesystem::create_symlink(dir / "nowhere.csv", dir / "more.csv");
  for (const char* name : {"rows.csv", "more.csv"}) {
    StatusOr<AppendFile> file = AppendFile::Create(dir / name);
    ASSERT_TRUE(file.ok()) << file.status().message();
    ASSERT_TRUE(file->Append("row").ok());
    EXPECT_EQ(ReadBytes(dir / name), "row");
    EXPECT_FALSE(std::filesystem::is_symlink(dir / name));
  }
  EXPECT_EQ(ReadBytes(dir / "other.csv"), "kept");
  EXPECT_FALSE(std::filesystem::exists(dir / "nowhere.csv"));
}

TEST(AppendFile, ReopenGoesOnBehindTheGivenSize) {
  const TemporaryDirectory dir;
  WriteBytes(dir / "rows.csv", "kept\ndropped\n");
  StatusOr<AppendFile> file = AppendFile::Reopen(dir / "rows.csv", 5);
  ASSERT_TRUE(file.ok()) << file.status().message();
  ASSERT_TRUE(file->Append("new\n").ok());
  EXPECT_EQ(ReadBytes(dir / "rows.csv"), "kept\nnew\n");
}

TEST(AppendFile, ReopenRefusesAFileThatIsShorterOrMissing) {
  const TemporaryDirectory dir;
  WriteBytes(dir / "rows.csv", "kept\n");
  const StatusOr<AppendFile> shorter = AppendFile::Reopen(dir / "rows.csv", 6);
  ASSERT_FALSE(shorter.ok());
  EXPECT_EQ(shorter.status().message(),
            dir / "rows.csv" + std::string(": has 5 bytes, expected the 6 that were there before"));
  EXPECT_EQ(ReadBytes(dir / "rows.csv"), "kept\n");
  EXPECT_THAT(AppendFile::Reopen(dir / "none.csv", 0).status().message(), HasSubstr("No such"));
}

TEST(AppendFile, TellsWhyItCannotBeMade) {
  const TemporaryDirectory dir;
  const StatusOr<AppendFile> file = AppendFile::Create(dir / "no/such/folder.csv");
  ASSERT_FALSE(file.ok());
  EXPECT_THAT(file.status().message(), HasSubstr("folder.csv: cannot write: "));
}

}  // namespace
}  // namespace ceres_ed
