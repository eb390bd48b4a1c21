#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/native_writer.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 4;
constexpr int kHeight = 3;

class NativeSequenceWriterTest : public ::testing::Test {
 protected:
  NativeSequenceWriterTest() : depth_(kWidth, kHeight, 0.1234F), color_(kWidth, kHeight) {
    options_.camera.camera = {5.0, 5.5, 1.5, 1.0, kWidth, kHeight};
    options_.camera.depth_units_per_metre = 10000.0;
    options_.truth_triangles = {{0, 1, 2}};
    depth_(1, 2) = 0.0F;
    color_(3, 0) = {10, 20, 30};
  }

  std::unique_ptr<NativeSequenceWriter> Create(const std::string& directory) {
    auto writer = NativeSequenceWriter::Create(directory, options_);
    EXPECT_TRUE(writer.ok()) << writer.status().message();
    return writer.ok() ? *std::move(writer) : nullptr;
  }

  // Returns frame k, in which the camera and the true surface have moved by k metres along x.
  FrameToWrite Frame(int k) {
    truth_ = {{k + 0.1, 0, 0}, {k + 1.0, 0, 0}, {0.0 + k, 2, 0.3}};
    FrameToWrite frame;
    frame.depth = &depth_;
    frame.color = &color_;
    frame.world_from_camera.translation.x() = k;
    frame.truth = &truth_;
    return frame;
  }

  bool Exists(const std::string& name) const { return std::filesystem::exists(dir_ / name); }

  TemporaryDirectory dir_;
  SequenceWriterOptions options_;
  DepthImage depth_;
  ColorImage color_;
  std::vector<Eigen::Vector3d> truth_;
};

TEST_F(NativeSequenceWriterTest, WritesWhatTheReadersOfItsFilesReadBack) {
  const std::string out = dir_ / "new/folder";
  const auto writer = Create(out);
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(writer->WriteFrame(Frame(k)).ok());
  EXPECT_EQ(writer->num_frames(), 3);
  ASSERT_TRUE(writer->Close().ok());

  const auto camera = ReadCameraFile(out + "/camera.txt");
  ASSERT_TRUE(camera.ok());
  EXPECT_EQ(camera->camera.fy, 5.5);
  EXPECT_EQ(camera->depth_units_per_metre, 10000.0);
  const auto poses = ReadPosesFile(out + "/poses.txt");
  ASSERT_TRUE(poses.ok());
  ASSERT_EQ(poses->size(), 3u);
  EXPECT_EQ((*poses)[2].frame, 2);
  EXPECT_EQ((*poses)[2].world_from_camera.translation.x(), 2.0);
  const auto depth = ReadDepthImage(out + "/depth/000002.png", 10000.0);
  ASSERT_TRUE(depth.ok());
  EXPECT_EQ(depth->pixels(), depth_.pixels());
  const auto color = ReadColorImage(out + "/color/000000.png");
  ASSERT_TRUE(color.ok());
  EXPECT_EQ(color->pixels(), color_.pixels());
  EXPECT_FALSE(std::filesystem::exists(out + "/mask"));
}

TEST_F(NativeSequenceWriterTest, StreamsTruthAsLittleEndianFloatsFromTheFirstMeshOn) {
  const auto writer = Create(dir_.path());
  for (int k = 0; k < 2; ++k) ASSERT_TRUE(writer->WriteFrame(Frame(k)).ok());
  ASSERT_TRUE(writer->Close().ok());
  const std::string bytes = ReadBytes(dir_ / "gt_vertices.f32");
  ASSERT_EQ(bytes.size(), 2u * 3u * 3u * 4u);
  float values[18];
  std::memcpy(values, bytes.data(), bytes.size());
  EXPECT_EQ(values[0], 0.1F);
  EXPECT_EQ(values[8], 0.3F);
  EXPECT_EQ(values[9], 1.1F);
  const auto mesh = LoadCloud(dir_ / "gt_mesh_000000.ply");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->cloud.triangles, options_.truth_triangles);
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(float(mesh->cloud.points[i][axis]), values[3 * i + axis]);
    }
  }
}

TEST_F(NativeSequenceWriterTest, WritesMasksThatReadBack) {
  const auto writer = Create(dir_.path());
  MaskImage mask(kWidth, kHeight, 0);
  mask(2, 1) = 1;
  FrameToWrite frame = Frame(0);
  frame.mask = &mask;
  ASSERT_TRUE(writer->WriteFrame(frame).ok());
  const auto read = ReadMaskImage(dir_ / "mask/000000.png");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->pixels(), mask.pixels());
}

TEST_F(NativeSequenceWriterTest, LeavesNoTruthAndNoTemporaryFilesWithoutAnEnd) {
  {
    const auto writer = Create(dir_.path());
    ASSERT_TRUE(writer->WriteFrame(Frame(0)).ok());
  }
  EXPECT_TRUE(Exists("camera.txt"));
  EXPECT_TRUE(Exists("depth/000000.png"));
  // camera.txt, depth and color.
  EXPECT_EQ(dir_.NumFiles(), 3u);
}

TEST_F(NativeSequenceWriterTest, RefusesAFolderWithASequence) {
  EXPECT_FALSE(HoldsNativeSequence(dir_.path()));
  ASSERT_TRUE(Create(dir_.path())->WriteFrame(Frame(0)).ok());
  EXPECT_TRUE(HoldsNativeSequence(dir_.path()));
  const auto second = NativeSequenceWriter::Create(dir_.path(), options_);
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.status().message(), HasSubstr(dir_.path() + ": holds a sequence already"));
}

TEST_F(NativeSequenceWriterTest, OverwritesAllOfASequenceAndNothingElse) {
  {
    const auto writer = Create(dir_.path());
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(writer->WriteFrame(Frame(k)).ok());
    ASSERT_TRUE(writer->Close().ok());
  }
  WriteBytes(dir_ / "notes.txt", "mine");
  WriteBytes(dir_ / "depth/preview.png", "mine");
  options_.overwrite = true;
  const auto writer = Create(dir_.path());
  FrameToWrite frame = Frame(0);
  frame.truth = nullptr;
  frame.color = nullptr;
  ASSERT_TRUE(writer->WriteFrame(frame).ok());
  ASSERT_TRUE(writer->Close().ok());
  EXPECT_TRUE(Exists("depth/000000.png"));
  for (const char* gone :
       {"depth/000001.png", "color/000000.png", "gt_vertices.f32", "gt_mesh_000000.ply"}) {
    EXPECT_FALSE(Exists(gone)) << gone;
  }
  EXPECT_EQ(ReadBytes(dir_ / "notes.txt"), "mine");
  EXPECT_EQ(ReadBytes(dir_ / "depth/preview.png"), "mine");
}

TEST_F(NativeSequenceWriterTest, NamesTheFileThatIsInTheWay) {
  WriteBytes(dir_ / "file", "");
  for (const std::string& path : {dir_ / "file", dir_ / "file/below"}) {
    const auto writer = NativeSequenceWriter::Create(path, options_);
    ASSERT_FALSE(writer.ok());
    EXPECT_THAT(writer.status().message(), HasSubstr(dir_ / "file"));
  }
}

}  // namespace
}  // namespace ceres_ed
