#include "ceres_ed/io/video/video_file.h"

#include <ceres_ed/io/module_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <list>
#include <mutex>
#include <utility>

namespace ceres_ed {
namespace {

StatusOr<const VideoModule*> LoadModule(const std::string& path) {
  const StatusOr<void*> symbol = OpenModule(CERES_ED_VIDEO_MODULE, kVideoModuleSymbol);
  if (!symbol.ok()) {
    return Status::Error(path +
                         ": videos need ceres_ed's module for them: install the package "
                         "ceres-ed-video, or libopencv-videoio-dev and build again (" +
                         symbol.status().message() + ")");
  }
  const VideoModule* const module = reinterpret_cast<VideoModuleFunction*>(*symbol)();
  if (module->version == std::string(CERES_ED_VERSION_STRING)) return module;
  return Status::Error(std::string(CERES_ED_VIDEO_MODULE) + " belongs to ceres_ed " +
                       module->version + ", expected " + CERES_ED_VERSION_STRING);
}

// Opens a video, after a check that gives the system's reason if the file can't be opened.
StatusOr<std::unique_ptr<VideoDecoder>> OpenVideo(const std::string& path) {
  std::ifstream file;
  const StatusOr<std::size_t> size = OpenRegularFile(path, &file);
  if (!size.ok()) return size.status();
  const StatusOr<const VideoModule*> module = LoadModule(path);
  if (!module.ok()) return module.status();
  return (*module)->open(path);
}

// A video with the frame that was decoded last.
class OpenedVideo {
 public:
  explicit OpenedVideo(std::string path) : path_(std::move(path)) {}
  const std::string& path() const { return path_; }

  StatusOr<ColorImage> Read(int frame) {
    if (decoder_ == nullptr || frame < current_) {
      StatusOr<std::unique_ptr<VideoDecoder>> decoder = OpenVideo(path_);
      if (!decoder.ok()) return decoder.status();
      decoder_ = *std::move(decoder);
      current_ = -1;
      picture_ = ColorImage();
    }
    while (current_ < frame) {
      if (!decoder_->Advance()) {
        const int end = current_ + 1;
        decoder_.reset();
        return Status::Error(path_ + ": ends after " + std::to_string(end) +
                             " frames, expected frame " + std::to_string(frame));
      }
      ++current_;
      picture_ = ColorImage();
    }
    if (picture_.empty()) {
      StatusOr<ColorImage> picture = decoder_->Frame();
      if (!picture.ok()) return picture.status();
      picture_ = *std::move(picture);
    }
    return picture_;
  }

 private:
  std::string path_;
  std::unique_ptr<VideoDecoder> decoder_;
  int current_ = -1;
  // The picture of `current_`; empty if nobody has asked for it.
  ColorImage picture_;
};

// The videos that stay open: left and right, with one to spare. The last one used comes first.
class OpenVideos {
 public:
  StatusOr<ColorImage> Read(const std::string& path, int frame) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = std::find_if(videos_.begin(), videos_.end(), [&path](const auto& video) {
      return video.path() == path;
    });
    if (found == videos_.end()) {
      videos_.emplace_front(path);
      if (videos_.size() > kMostOpen) videos_.pop_back();
    } else {
      videos_.splice(videos_.begin(), videos_, found);
    }
    StatusOr<ColorImage> picture = videos_.front().Read(frame);
    if (!picture.ok()) videos_.pop_front();
    return picture;
  }

 private:
  static constexpr std::size_t kMostOpen = 3;
  std::mutex mutex_;
  std::list<OpenedVideo> videos_;
};

}  // namespace

bool IsVideoName(const std::string& path) {
  static constexpr std::array kEndings = {
      ".avi", ".mp4", ".mkv", ".mov", ".mpg", ".mpeg", ".m4v", ".webm", ".wmv"};
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

StatusOr<VideoInfo> ReadVideoInfo(const std::string& path) {
  const StatusOr<std::unique_ptr<VideoDecoder>> decoder = OpenVideo(path);
  if (!decoder.ok()) return decoder.status();
  VideoInfo info = (*decoder)->info();
  // Some containers do not say how many frames there are.
  if (info.num_frames <= 0) {
    info.num_frames = 0;
    while ((*decoder)->Advance()) ++info.num_frames;
  }
  return info;
}

StatusOr<ColorImage> ReadVideoFrame(const std::string& path, int frame) {
  // Never destroyed: threads may still read when a program ends.
  static OpenVideos* const videos = new OpenVideos;
  return videos->Read(path, frame);
}

StatusOr<std::unique_ptr<VideoEncoder>> CreateVideo(const std::string& path,
                                                    int width,
                                                    int height,
                                                    double frames_per_second) {
  const StatusOr<const VideoModule*> module = LoadModule(path);
  if (!module.ok()) return module.status();
  return (*module)->create(path, width, height, frames_per_second);
}

}  // namespace ceres_ed
