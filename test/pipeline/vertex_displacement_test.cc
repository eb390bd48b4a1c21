#include <ceres_ed/pipeline/apply/vertex_displacement.h>

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

TEST(WithDisplacement, AddsColumnsAndLeavesTheRestAsItIs) {
  const TemporaryDirectory directory;
  // The second vertex is left out when the file is read.
  WriteBytes(directory / "a.ply", AsciiMesh({"1 2 3", "nan 0 0", "4 5 6", "0 1 0"}, {"3 0 2 3"}));
  const StatusOr<LoadedCloud> loaded = LoadCloud(directory / "a.ply");
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  const std::vector<Eigen::Vector3d> moved = {{1.5, 2, 3}, {4, 6, 6}, {0, 1, -2}};
  PlyDocument document = WithDisplacement(*loaded, moved);
  const PlyElement& vertices = *document.Find("vertex");
  EXPECT_EQ(vertices.Find("displacement_0")->values, (std::vector<double>{0.5, 0, 0, 0}));
  EXPECT_EQ(vertices.Find("displacement_1")->values, (std::vector<double>{0, 0, 1, 0}));
  EXPECT_EQ(vertices.Find("displacement_2")->values, (std::vector<double>{0, 0, 0, -2}));
  EXPECT_EQ(vertices.Find("displacement_2")->type, PlyType::kFloat32);
  EXPECT_EQ(vertices.Find("y")->values, loaded->document.Find("vertex")->Find("y")->values);
  EXPECT_THAT(document.obj_info,
              ::testing::ElementsAre("vtk_array vertex 3 vectors displacement_0 displacement"));

  // Once more: the columns are replaced.
  LoadedCloud again = *loaded;
  again.document = document;
  EXPECT_EQ(WithDisplacement(again, moved).Find("vertex")->properties.size(), 6u);
}

}  // namespace
}  // namespace ceres_ed
