#include "ceres_ed/pipeline/outputs.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

TEST(PrepareOutput, MakesTheFolderAndNoFile) {
  const TemporaryDirectory dir;
  const Status status = PrepareOutput(dir / "a/b/out.ply");
  EXPECT_TRUE(status.ok()) << status.message();
  EXPECT_TRUE(std::filesystem::is_directory(dir / "a/b"));
  EXPECT_TRUE(std::filesystem::is_empty(dir / "a/b"));
}

TEST(PrepareOutput, LeavesAFileThatIsThereAsItIs) {
  const TemporaryDirectory dir;
  WriteBytes(dir / "out.ply", "old");
  EXPECT_TRUE(PrepareOutput(dir / "out.ply").ok());
  EXPECT_EQ(ReadBytes(dir / "out.ply"), "old");
  EXPECT_EQ(dir.NumFiles(), 1u);
}

TEST(PrepareOutput, NamesThePathThatCannotBe) {
  const TemporaryDirectory dir;
  WriteBytes(dir / "file", "");
  EXPECT_THAT(PrepareOutput(dir / "file/out.ply").message(), HasSubstr(dir / "file/out.ply"));
  EXPECT_THAT(PrepareOutput(dir.path()).message(), HasSubstr(dir.path()));
}

}  // namespace
}  // namespace ceres_ed
