#include "ceres_ed/io/sequence/scene_truth.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

constexpr int kFrames = 3;

class SceneTruthTest : public ::testing::Test {
 protected:
  SceneTruthTest() {
    auto writer = SceneTruthWriter::Create(dir_.path(), {{0, 1, 2}});
    EXPECT_TRUE(writer.ok()) << writer.status().message();
    for (int frame = 0; frame < kFrames; ++frame) {
      EXPECT_TRUE((*writer)->Add(PointsOf(frame)).ok());
      CameraPose pose;
      pose.translation = {0.0, 0.0, -1.0 * frame};
      poses_[frame] = pose;
    }
    EXPECT_FALSE(HoldsSceneTruth(dir_.path()));
    EXPECT_TRUE((*writer)->Close().ok());
  }

  static std::vector<Eigen::Vector3d> PointsOf(int frame) {
    return {{0.0, 0.0, 1.0}, {0.5, 0.0, 1.0}, {0.0, 0.25 * frame, 1.0}};
  }

  std::string Error() const { return ReadSceneTruth(dir_.path(), poses_).status().message(); }

  TemporaryDirectory dir_;
  std::map<int, CameraPose> poses_;
};

TEST_F(SceneTruthTest, ReadsBackAsWritten) {
  EXPECT_TRUE(HoldsSceneTruth(dir_.path()));
  const StatusOr<SceneTruth> truth = ReadSceneTruth(dir_.path(), poses_);
  ASSERT_TRUE(truth.ok()) << truth.status().message();
  EXPECT_EQ(truth->num_frames(), kFrames);
  EXPECT_TRUE(truth->Has(2));
  EXPECT_FALSE(truth->Has(3));
  const PointCloud mesh = truth->InCamera(2);
  ASSERT_EQ(mesh.size(), 3u);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(mesh.points[i], PointsOf(2)[i] - poses_[2].translation);
  }
}

TEST_F(SceneTruthTest, StoresLittleEndianFloats) {
  const std::string bytes = ReadBytes(dir_ / kTruthVerticesName);
  ASSERT_EQ(bytes.size(), 12u * 3u * kFrames);
  // 1 and 0.5 in the format of IEEE 754.
  EXPECT_EQ(bytes.substr(8, 4), std::string("\x00\x00\x80\x3f", 4));
  EXPECT_EQ(bytes.substr(12, 4), std::string("\x00\x00\x00\x3f", 4));
}

TEST_F(SceneTruthTest, NamesAFileOfAnotherSize) {
  std::filesystem::resize_file(dir_ / kTruthVerticesName, 12 * 3 * kFrames - 4);
  EXPECT_THAT(Error(), HasSubstr("gt_vertices.f32: 104 bytes, expected 36"));
  std::filesystem::resize_file(dir_ / kTruthVerticesName, 12 * 3 * (kFrames - 1));
  EXPECT_THAT(Error(), HasSubstr("for each of 3 frames"));
  std::filesystem::remove(dir_ / kTruthMeshName);
  EXPECT_THAT(Error(), HasSubstr(kTruthMeshName));
}

}  // namespace
}  // namespace ceres_ed
