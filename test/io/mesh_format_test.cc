#include "ceres_ed/io/mesh/mesh_format.h"

#include "io_test_util.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/mesh_module.h>

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

TEST(MeshFormat, IsChosenByTheEndingInLettersOfEitherCase) {
  EXPECT_STREQ(FindMeshFormat("a.ply")->ending, ".ply");
  EXPECT_STREQ(FindMeshFormat("folder.x/A.PCD")->ending, ".pcd");
  EXPECT_STREQ(FindMeshFormat("a.ply.StL")->ending, ".stl");
  // Names without an ending and devices are PLY.
  EXPECT_STREQ(FindMeshFormat("a")->ending, ".ply");
  EXPECT_STREQ(FindMeshFormat("/dev/fd.x")->ending, ".ply");
  EXPECT_STREQ(FindMeshFormat("")->ending, ".ply");
  EXPECT_EQ(FindMeshFormat("a.mesh"), nullptr);
}

TEST(MeshFormat, APlyIsReadUnderAnyOtherName) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "a.mesh", RichPly(Encoding::kLittle, false));
  const StatusOr<PlyDocument> document = ReadMesh(directory / "a.mesh");
  ASSERT_TRUE(document.ok()) << document.status().message();
  EXPECT_TRUE(document->warnings.empty());
}

TEST(MeshFormat, AMissingFileIsNamedBeforeAMissingModule) {
  const TemporaryDirectory directory;
  EXPECT_EQ(LoadCloud(directory / "none.pcd").status().message(),
            directory / "none.pcd" + ": cannot read: No such file or directory");
}

TEST(MeshModule, OneThatIsNotThereIsAnError) {
  const StatusOr<const MeshModule*> module = LoadMeshModule("libceres_ed_nobody.so.0");
  ASSERT_FALSE(module.ok());
  EXPECT_THAT(module.status().message(), HasSubstr("libceres_ed_nobody.so.0"));
}

TEST(MeshModule, ALibraryThatIsNoModuleIsAnError) {
  const StatusOr<const MeshModule*> module = LoadMeshModule("libm.so.6");
  ASSERT_FALSE(module.ok());
  EXPECT_EQ(module.status().message(), "libm.so.6 exports no ceres_ed_mesh_module");
}

}  // namespace
}  // namespace ceres_ed
