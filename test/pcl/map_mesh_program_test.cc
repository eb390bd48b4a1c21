// The surface that ed_slam --mesh makes of a map.
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <test/cli/ed_slam_test_util.h>

namespace ceres_ed {
namespace {

class MapMeshProgramTest : public EdSlamTest {
 protected:
  MapMeshProgramTest() { WriteBumpySequence(Sequence(), 2); }
  std::string MeshFlag() const { return "--mesh=" + (dir_ / "mesh.ply"); }
};

TEST_F(MapMeshProgramTest, ConnectsThePointsOfTheMap) {
  const ProgramResult result = Run("out", {MeshFlag(), "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const LoadedCloud mesh = Load("mesh.ply");
  EXPECT_EQ(mesh.cloud.points, Load("out/map.ply").cloud.points);
  // A closed sheet would have two faces a point; its rim has fewer.
  EXPECT_GT(mesh.cloud.triangles.size(), mesh.cloud.size());
}

TEST_F(MapMeshProgramTest, SaysBeforeTheRunThatTheModuleCannotBeLoaded) {
  WriteBytes(dir_ / CERES_ED_PCL_MODULE, "no library");
  ASSERT_EQ(setenv("CERES_ED_MODULES", dir_.path().c_str(), 1), 0);
  const ProgramResult result = Run("out", {MeshFlag(), "--quiet"});
  unsetenv("CERES_ED_MODULES");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              ::testing::HasSubstr("mesh.ply: a surface needs ceres_ed's module for PCL: install"));
  EXPECT_FALSE(Exists("out/map.ply"));
}

}  // namespace
}  // namespace ceres_ed
