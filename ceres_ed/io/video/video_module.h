// What the shared object for videos offers to the library, which loads it when it meets a video.
#ifndef CERES_ED_IO_VIDEO_VIDEO_MODULE_H_
#define CERES_ED_IO_VIDEO_VIDEO_MODULE_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>

namespace ceres_ed {

// What a video says about itself.
struct VideoInfo {
  int width = 0;
  int height = 0;
  // As the file says; the last frames may be missing nevertheless.
  int num_frames = 0;
  // 0 if unknown.
  double frames_per_second = 0.0;
};

// Decodes a video from its first frame on.
class VideoDecoder {
 public:
  virtual ~VideoDecoder() = default;
  virtual const VideoInfo& info() const = 0;
  // Goes to the next frame, at first to frame 0. Returns false at the end.
  virtual bool Advance() = 0;
  // Returns the frame to which Advance() went.
  virtual StatusOr<ColorImage> Frame() = 0;
};

// Encodes a video frame by frame.
class VideoEncoder {
 public:
  virtual ~VideoEncoder() = default;
  // The frame must have the size of the video.
  virtual Status Add(const ColorImage& frame) = 0;
  // Completes the file. Call it once, at the end.
  virtual Status Close() = 0;
};

// The functions of the module. It exports the function kVideoModuleSymbol, which has no parameters
// and returns one of these.
struct VideoModule {
  // The version of ceres_ed with which it was built.
  const char* version;
  StatusOr<std::unique_ptr<VideoDecoder>> (*open)(const std::string& path);
  // The ending of `path` decides about the container: .avi is written without loss, .mp4 is not.
  // Sizes are even numbers.
  StatusOr<std::unique_ptr<VideoEncoder>> (*create)(const std::string& path,
                                                    int width,
                                                    int height,
                                                    double frames_per_second);
};

using VideoModuleFunction = const VideoModule*();
inline constexpr char kVideoModuleSymbol[] = "ceres_ed_video_module";

}  // namespace ceres_ed

#endif  // CERES_ED_IO_VIDEO_VIDEO_MODULE_H_
