// Frames of videos.
#ifndef CERES_ED_IO_VIDEO_VIDEO_FILE_H_
#define CERES_ED_IO_VIDEO_VIDEO_FILE_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/io/video/video_module.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>

namespace ceres_ed {

// Returns whether the ending of a name is that of a video: avi, mp4, mkv, mov, mpg, mpeg, m4v, webm
// or wmv.
bool IsVideoName(const std::string& path);

// Returns size and length of a video. The error names the file: it can't be read, is no video, or
// the module for videos is not installed.
StatusOr<VideoInfo> ReadVideoInfo(const std::string& path);

// Returns frame `frame` >= 0 of a video. Frames are decoded one after the other from the start, so
// that a frame is the same however it is reached; a few videos stay open between calls, and asking
// for frames in ascending order, or for the same frame again, decodes each frame once. It is safe
// to call this from several threads. Errors are as those of ReadVideoInfo(), or say where the video
// ends.
StatusOr<ColorImage> ReadVideoFrame(const std::string& path, int frame);

// Creates a video (video_module.h).
StatusOr<std::unique_ptr<VideoEncoder>> CreateVideo(const std::string& path,
                                                    int width,
                                                    int height,
                                                    double frames_per_second);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_VIDEO_VIDEO_FILE_H_
