// Videos by OpenCV, for programs that load this module when a recording is one.
#include <ceres_ed/io/video/video_module.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

namespace ceres_ed {
namespace {

class OpenCvDecoder : public VideoDecoder {
 public:
  explicit OpenCvDecoder(std::string path) : path_(std::move(path)) {}

  Status Open() {
    // Other decoders may count frames otherwise.
    if (!capture_.open(path_, cv::CAP_FFMPEG)) {
      return Status::Error(path_ + ": no video that can be read");
    }
    info_.width = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH));
    info_.height = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT));
    // Absurd numbers are what OpenCV answers where the file says nothing.
    constexpr double kMostFrames = 5e6;
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    info_.num_frames = count > 0.0 && count < kMostFrames ? static_cast<int>(count) : 0;
    const double rate = capture_.get(cv::CAP_PROP_FPS);
    constexpr double kFastest = 1e5;
    info_.frames_per_second = rate > 0.0 && rate < kFastest ? rate : 0.0;
    if (info_.width > 0 && info_.height > 0) return Status::Ok();
    return Status::Error(path_ + ": a video without a size, expected pictures");
  }

  const VideoInfo& info() const override { return info_; }
  bool Advance() override { return capture_.grab(); }

  StatusOr<ColorImage> Frame() override {
    cv::Mat picture;
    if (!capture_.retrieve(picture) || picture.type() != CV_8UC3) {
      return Status::Error(path_ + ": a frame can't be decoded");
    }
    ColorImage color(picture.cols, picture.rows);
    for (int v = 0; v < picture.rows; ++v) {
      const unsigned char* row = picture.ptr<unsigned char>(v);
      for (int u = 0; u < picture.cols; ++u) {
        color(u, v) = {row[3 * u + 2], row[3 * u + 1], row[3 * u]};
      }
    }
    return color;
  }

 private:
  std::string path_;
  cv::VideoCapture capture_;
  VideoInfo info_;
};

class OpenCvEncoder : public VideoEncoder {
 public:
  explicit OpenCvEncoder(std::string path) : path_(std::move(path)) {}

  Status Open(int width, int height, double frames_per_second) {
    const bool is_avi = path_.size() > 4 && path_.substr(path_.size() - 4) == ".avi";
    const int codec = is_avi ? cv::VideoWriter::fourcc('F', 'F', 'V', '1')
                             : cv::VideoWriter::fourcc('m', 'p', '4', 'v');
    if (writer_.open(path_, cv::CAP_FFMPEG, codec, frames_per_second, {width, height})) {
      return Status::Ok();
    }
    return Status::Error(path_ + ": can't be written as a video of " + std::to_string(width) +
                         " x " + std::to_string(height) + " pixels");
  }

  Status Add(const ColorImage& frame) override {
    cv::Mat picture(frame.height(), frame.width(), CV_8UC3);
    for (int v = 0; v < picture.rows; ++v) {
      unsigned char* row = picture.ptr<unsigned char>(v);
      for (int u = 0; u < picture.cols; ++u) {
        const auto& rgb = frame(u, v);
        std::copy(rgb.rbegin(), rgb.rend(), row + 3 * u);
      }
    }
    writer_.write(picture);
    return Status::Ok();
  }

  Status Close() override {
    writer_.release();
    return Status::Ok();
  }

 private:
  std::string path_;
  cv::VideoWriter writer_;
};

StatusOr<std::unique_ptr<VideoDecoder>> OpenDecoder(const std::string& path) {
  auto decoder = std::make_unique<OpenCvDecoder>(path);
  try {
    Status status = decoder->Open();
    if (!status.ok()) return status;
  } catch (const std::exception& error) {
    return Status::Error(path + ": no video that can be read: " + error.what());
  }
  return StatusOr<std::unique_ptr<VideoDecoder>>(std::move(decoder));
}

StatusOr<std::unique_ptr<VideoEncoder>> CreateEncoder(const std::string& path,
                                                      int width,
                                                      int height,
                                                      double frames_per_second) {
  auto encoder = std::make_unique<OpenCvEncoder>(path);
  try {
    Status status = encoder->Open(width, height, frames_per_second);
    if (!status.ok()) return status;
  } catch (const std::exception& error) {
    return Status::Error(path + ": can't be written as a video: " + error.what());
  }
  return StatusOr<std::unique_ptr<VideoEncoder>>(std::move(encoder));
}

}  // namespace
}  // namespace ceres_ed

extern "C" [[gnu::visibility("default")]] const ceres_ed::VideoModule* ceres_ed_video_module() {
  static const ceres_ed::VideoModule module = {
      CERES_ED_VERSION_STRING, ceres_ed::OpenDecoder, ceres_ed::CreateEncoder};
  return &module;
}
