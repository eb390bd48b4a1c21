#include "ceres_ed/io/sequence/layouts/layout_files.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/picture_reader.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/io/video/video_file.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Names(const std::string& folder, bool folders) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    std::error_code ignored;
    const bool is_wanted = folders ? it->is_directory(ignored) : it->is_regular_file(ignored);
    if (is_wanted && name[0] != '.') names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

// Returns nothing if the principal point lies in a picture of this size.
std::optional<std::string> OutsideText(const PinholeCamera& camera, int width, int height) {
  const bool is_inside =
      camera.cx > 0.0 && camera.cy > 0.0 && camera.cx < width && camera.cy < height;
  if (is_inside) return std::nullopt;
  std::ostringstream text;
  text << "the principal point (" << camera.cx << ", " << camera.cy
       << ") is outside the pictures of " << SizeText(width, height)
       << ", expected the intrinsics of these pictures: if they were resized, multiply fx, fy, cx "
          "and cy by the same factor";
  return text.str();
}

void Scale(double factor, PinholeCamera* camera) {
  // Pixel centres have whole numbers, so that the corner of the picture is at -0.5.
  camera->fx *= factor;
  camera->fy *= factor;
  camera->cx = (camera->cx + 0.5) * factor - 0.5;
  camera->cy = (camera->cy + 0.5) * factor - 0.5;
}

// Returns the numbers of frames and their times in a video.
StatusOr<VideoInfo> OpenedInfo(const std::string& path) {
  StatusOr<VideoInfo> info = ReadVideoInfo(path);
  if (!info.ok()) return info;
  if (info->num_frames < 1) return Status::Error(path + ": no frame, expected at least one");
  return info;
}

void AddFrames(int count,
               int first_number,
               double frames_per_second,
               const std::function<StereoSources(int)>& sources,
               SequenceListing* listing) {
  for (int i = 0; i < count; ++i) {
    SequenceEntry entry;
    entry.number = first_number + i;
    entry.time_s = frames_per_second > 0.0 ? i / frames_per_second : entry.number;
    const StereoSources pair = sources(i);
    entry.color = pair.left;
    entry.right = pair.right;
    listing->entries.push_back(std::move(entry));
  }
  listing->has_color = true;
}

}  // namespace

std::vector<std::string> FileNames(const std::string& folder) { return Names(folder, false); }

std::vector<std::string> FolderNames(const std::string& folder) { return Names(folder, true); }

std::map<int, std::string> FilesByNumber(const std::string& folder, const std::string& suffix) {
  std::map<int, std::string> files;
  for (const std::string& name : FileNames(folder)) {
    if (name.size() <= suffix.size()) continue;
    const std::size_t stem = name.size() - suffix.size();
    if (name.compare(stem, suffix.size(), suffix) != 0) continue;
    const std::size_t last_other = name.find_last_not_of("0123456789", stem - 1);
    const std::size_t begin = last_other == std::string::npos ? 0 : last_other + 1;
    const StatusOr<int> number =
        ParseNatural("", "", std::string_view(name).substr(begin, stem - begin));
    if (number.ok()) files.emplace(*number, JoinPath(folder, name));
  }
  return files;
}

void AddMasksByNumber(const std::map<int, std::string>& masks, SequenceListing* listing) {
  std::size_t count = 0;
  for (SequenceEntry& entry : listing->entries) {
    const auto mask = masks.find(entry.number);
    if (mask == masks.end()) continue;
    entry.mask.path = mask->second;
    ++count;
  }
  // Only every second frame has one.
  const std::size_t num_frames = listing->entries.size();
  if (count < 2 || 5 * count < 2 * num_frames || 5 * count > 3 * num_frames) return;
  std::size_t filled = 0;
  for (std::size_t i = 1; i < num_frames; ++i) {
    SequenceEntry& entry = listing->entries[i];
    if (!entry.mask.empty() || listing->entries[i - 1].mask.empty()) continue;
    entry.mask = listing->entries[i - 1].mask;
    ++filled;
  }
  listing->warnings.push_back(std::to_string(count) + " masks for " + std::to_string(num_frames) +
                              " frames: " + std::to_string(filled) +
                              " frames take that of the frame before");
}

std::vector<TimedPicture> PicturesInOrder(const std::string& folder,
                                          const std::vector<std::string>& endings) {
  std::vector<TimedPicture> pictures;
  for (const std::string& name : FileNames(folder)) {
    const fs::path path(name);
    const bool is_wanted =
        std::find(endings.begin(), endings.end(), path.extension().string()) != endings.end();
    if (!is_wanted) continue;
    const std::string stem = path.stem().string();
    const std::optional<double> time_s = TimeInName(stem);
    TimedPicture picture;
    picture.path = JoinPath(folder, name);
    const std::size_t last_other = stem.find_last_not_of("0123456789");
    const std::size_t begin = last_other == std::string::npos ? 0 : last_other + 1;
    const StatusOr<int> number = ParseNatural("", "", std::string_view(stem).substr(begin));
    picture.time_s = time_s.has_value() ? *time_s : number.ok() ? *number : 0.0;
    pictures.push_back(std::move(picture));
  }
  std::stable_sort(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) {
    return a.time_s < b.time_s;
  });
  return pictures;
}

std::vector<std::string> VideosIn(const std::string& folder) {
  std::vector<std::string> videos;
  for (const std::string& name : FileNames(folder)) {
    if (IsVideoName(name)) videos.push_back(JoinPath(folder, name));
  }
  return videos;
}

std::string FirstFile(const std::string& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::string path = JoinPath(folder, name);
    if (IsFile(path)) return path;
  }
  return "";
}

StatusOr<std::pair<int, int>> ReadSourceSize(const PictureSource& source) {
  const StatusOr<ColorImage> picture = ReadColor(source);
  if (!picture.ok()) return picture.status();
  return std::make_pair(picture->width(), picture->height());
}

Status MissingCalibration(const std::string& path, const std::string& form) {
  return Status::Error(path + ": not there, expected the calibration of the cameras: " + form);
}

Status FitCamera(const std::string& path, int width, int height, PinholeCamera* camera) {
  camera->width = width;
  camera->height = height;
  const std::optional<std::string> outside = OutsideText(*camera, width, height);
  return outside.has_value() ? Status::Error(path + ": " + *outside) : Status::Ok();
}

Status FitCalibration(const std::string& path,
                      int width,
                      int height,
                      StereoCalibration* calibration) {
  for (PinholeCamera* camera : {&calibration->rig.left.pinhole, &calibration->rig.right.pinhole}) {
    if (camera->width == 0) {
      Status status = FitCamera(path, width, height, camera);
      if (!status.ok()) return status;
    }
    if (camera->width == width && camera->height == height) continue;
    const double factor = static_cast<double>(width) / camera->width;
    const std::string sizes = path + ": is for pictures of " +
                              SizeText(camera->width, camera->height) + ", and these have " +
                              SizeText(width, height);
    if (std::abs(factor * camera->height - height) > 1.0) {
      return Status::Error(sizes + ", expected the same size or the same ratio of width to height");
    }
    Scale(factor, camera);
    camera->width = width;
    camera->height = height;
    if (camera != &calibration->rig.left.pinhole) continue;
    std::ostringstream remark;
    remark << sizes << ": the intrinsics are scaled by " << factor;
    calibration->remarks.push_back(remark.str());
  }
  return Status::Ok();
}

StatusOr<bool> UseCameraFile(const std::string& directory, PinholeCamera* camera) {
  const std::string path = JoinPath(directory, "camera.txt");
  if (!IsFile(path)) return false;
  const StatusOr<CameraFile> file = ReadCameraFile(path);
  if (!file.ok()) return file.status();
  *camera = file->camera;
  return true;
}

void SetCalibration(const StereoCalibration& calibration, SequenceListing* listing) {
  listing->rig = calibration.rig;
  listing->is_rectified = calibration.is_rectified;
  listing->camera.camera = calibration.rig.left.pinhole;
  listing->warnings.insert(
      listing->warnings.end(), calibration.remarks.begin(), calibration.remarks.end());
}

StereoSources SourcesInVideo(const std::string& path, Stacking stacking, int video_frame) {
  switch (stacking) {
    case Stacking::kVertical:
      return {{path, video_frame, PicturePart::kTop}, {path, video_frame, PicturePart::kBottom}};
    case Stacking::kHorizontal:
      return {{path, video_frame, PicturePart::kLeft}, {path, video_frame, PicturePart::kRight}};
    case Stacking::kRows:
      break;
  }
  return {{path, video_frame, PicturePart::kEvenRows}, {path, video_frame, PicturePart::kOddRows}};
}

Status AddStackedVideo(const std::string& path,
                       Stacking stacking,
                       int first_number,
                       SequenceListing* listing) {
  const StatusOr<VideoInfo> info = OpenedInfo(path);
  if (!info.ok()) return info.status();
  AddFrames(
      info->num_frames,
      first_number,
      info->frames_per_second,
      [&](int i) { return SourcesInVideo(path, stacking, i); },
      listing);
  return Status::Ok();
}

Status AddTwoVideos(const std::string& left,
                    const std::string& right,
                    int first_number,
                    SequenceListing* listing) {
  const StatusOr<VideoInfo> left_info = OpenedInfo(left);
  if (!left_info.ok()) return left_info.status();
  const StatusOr<VideoInfo> right_info = OpenedInfo(right);
  if (!right_info.ok()) return right_info.status();
  if (left_info->num_frames != right_info->num_frames) {
    listing->warnings.push_back(left + ": has " + std::to_string(left_info->num_frames) +
                                " frames and " + right + " has " +
                                std::to_string(right_info->num_frames) +
                                "; the last ones of the longer video are left out");
  }
  AddFrames(
      std::min(left_info->num_frames, right_info->num_frames),
      first_number,
      left_info->frames_per_second,
      [&](int i) {
        return StereoSources{{left, i, PicturePart::kWhole}, {right, i, PicturePart::kWhole}};
      },
      listing);
  return Status::Ok();
}

StatusOr<Stacking> FindStacking(const std::string& path,
                                int width,
                                int height,
                                SequenceListing* listing) {
  const StatusOr<ColorImage> first = ReadColor({path, 0, PicturePart::kWhole});
  if (!first.ok()) return first.status();
  const StackingGuess guess = GuessStacking(*first, width, height);
  listing->warnings.push_back(path + ": " + guess.text);
  return guess.stacking;
}

}  // namespace ceres_ed
