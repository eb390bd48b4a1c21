#include "ceres_ed/pipeline/slam/frame_reader.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>

#include <filesystem>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <test/io/io_test_util.h>
#include <test/stereo/stereo_scenes.h>

namespace ceres_ed {
namespace {

// A stereo sequence of a plane that moves away.
class FrameReaderTest : public ::testing::Test {
 protected:
  static constexpr int kNumFrames = 5;

  void SetUp() override {
    const StereoRig rig = RectifiedTestRig();
    for (const char* side : {"left", "right"}) {
      std::filesystem::create_directories(directory_ / side);
    }
    for (int k = 0; k < kNumFrames; ++k) {
      const std::vector<TexturedPlane> planes = {
          {Eigen::Vector3d(0.2, 0.1, 1.0).normalized(), 0.055 + 0.001 * k}};
      const std::string name = "/00000" + std::to_string(k) + ".png";
      const ColorImage left = Photograph(planes, rig.left.pinhole, {});
      const ColorImage right = Photograph(planes, rig.right.pinhole, rig.right_from_left);
      ASSERT_TRUE(WriteColorImage(directory_ / ("left" + name), left).ok());
      ASSERT_TRUE(WriteColorImage(directory_ / ("right" + name), right).ok());
    }
    ASSERT_TRUE(WriteStereoFile(directory_ / "stereo.txt", rig).ok());
    auto source = OpenDepthSource(directory_.path(), {}, {});
    ASSERT_TRUE(source.ok()) << source.status().message();
    source_ = *std::move(source);
  }

  void ExpectFrame(int index, FrameReader* reader) const {
    const StatusOr<DepthFrame> expected = source_->Load(index);
    const ReadFrame read = reader->Read(index);
    ASSERT_TRUE(expected.ok() && read.frame.ok()) << index;
    EXPECT_EQ(read.problem, FrameProblem::kNone);
    EXPECT_EQ(read.frame->number, index);
    EXPECT_EQ(read.frame->depth.pixels(), expected->depth.pixels()) << index;
  }

  TemporaryDirectory directory_;
  std::unique_ptr<DepthSource> source_;
};

TEST_F(FrameReaderTest, GivesTheSameFramesAtAnyNumberOfThreads) {
  for (const int num_threads : {1, 2, 4}) {
    FrameReader reader(*source_, num_threads);
    for (int k = 0; k < kNumFrames; ++k) ExpectFrame(k, &reader);
  }
}

TEST_F(FrameReaderTest, FindsFramesThatWereNotTheNext) {
  FrameReader reader(*source_, 2);
  for (const int k : {0, 3, 1, 4, 4}) ExpectFrame(k, &reader);
}

TEST_F(FrameReaderTest, PassesOnWhyThereIsNoFrame) {
  std::filesystem::resize_file(directory_ / "right/000002.png", 100);
  FrameReader reader(*source_, 2);
  for (int k = 0; k < kNumFrames; ++k) EXPECT_EQ(reader.Read(k).frame.ok(), k != 2) << k;
}

}  // namespace
}  // namespace ceres_ed
