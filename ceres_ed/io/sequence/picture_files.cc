#include "ceres_ed/io/sequence/picture_files.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/picture_reader.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

std::string Lowercase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return text;
}

// Returns the number in the digits at the end of the name's stem; nothing if there are none or too
// many.
std::optional<int> FrameNumber(const fs::path& name) {
  const std::string stem = name.stem().string();
  const std::size_t last_other = stem.find_last_not_of("0123456789");
  const std::size_t begin = last_other == std::string::npos ? 0 : last_other + 1;
  const StatusOr<int> number = ParseNatural("", "", std::string_view(stem).substr(begin));
  if (!number.ok()) return std::nullopt;
  return *number;
}

// Returns whether every name is a time.
bool AreTimes(const std::vector<fs::path>& names) {
  return !names.empty() && std::all_of(names.begin(), names.end(), [](const fs::path& name) {
    return TimeInName(name.stem().string()).has_value();
  });
}

// Numbers pictures by time: the times of the first folder are numbered from 0 in ascending order,
// and a picture of another folder gets the number of the nearest time within 0.02 s.
std::map<int, std::string> NumberByTime(const std::string& folder,
                                        const std::vector<fs::path>& names,
                                        std::vector<double>* times) {
  constexpr double kMaxTimeDifference = 0.02;
  std::vector<std::pair<double, std::string>> timed;
  timed.reserve(names.size());
  for (const fs::path& name : names) {
    timed.emplace_back(*TimeInName(name.stem().string()), JoinPath(folder, name.string()));
  }
  std::sort(timed.begin(), timed.end());
  const bool is_first = times->empty();
  std::map<int, std::string> pictures;
  for (const auto& [time_s, path] : timed) {
    if (is_first) {
      times->push_back(time_s);
      pictures.emplace(static_cast<int>(times->size()) - 1, path);
      continue;
    }
    const auto next = std::lower_bound(times->begin(), times->end(), time_s);
    const bool takes_earlier =
        next == times->end() || (next != times->begin() && time_s - *(next - 1) < *next - time_s);
    const auto nearest = takes_earlier ? next - 1 : next;
    if (std::abs(*nearest - time_s) > kMaxTimeDifference) continue;
    pictures.emplace(static_cast<int>(nearest - times->begin()), path);
  }
  return pictures;
}

// Returns the path of a number, or an empty path.
std::string PathOf(const std::map<int, std::string>& pictures, int number) {
  const auto entry = pictures.find(number);
  return entry == pictures.end() ? std::string() : entry->second;
}

}  // namespace

std::string JoinPath(const std::string& directory, const std::string& name) {
  return (fs::path(directory) / name).string();
}

bool IsFolder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool IsFile(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool IsEmptyFolder(const std::string& path) {
  std::error_code ignored;
  return fs::is_empty(path, ignored);
}

StatusOr<std::pair<int, int>> ReadPictureSize(const std::string& path) {
  // The signature, the length and name of the first chunk, then width and height.
  constexpr std::string_view kPngStart("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  std::array<char, 24> header{};
  std::ifstream file(path, std::ios::binary);
  file.read(header.data(), header.size());
  const auto read_big_endian = [&header](std::size_t begin) {
    std::uint32_t number = 0;
    for (std::size_t i = begin; i < begin + 4; ++i) {
      number = number << 8U | static_cast<unsigned char>(header[i]);
    }
    return number;
  };
  constexpr std::uint32_t kLargest = 32768;
  if (file && std::string_view(header.data(), kPngStart.size()) == kPngStart) {
    const std::uint32_t width = read_big_endian(16);
    const std::uint32_t height = read_big_endian(20);
    if (width > 0 && height > 0 && width <= kLargest && height <= kLargest) {
      return std::make_pair(static_cast<int>(width), static_cast<int>(height));
    }
  }
  const StatusOr<DepthImage> depth = ReadDepthImage(path, 1.0);
  if (!depth.ok()) return depth.status();
  return std::make_pair(depth->width(), depth->height());
}

std::string ShortDepthWarning(const std::string& path, double units_per_metre) {
  // The number of bits stands behind width and height.
  constexpr std::size_t kBits = 24;
  std::array<char, kBits + 1> header{};
  std::ifstream file(path, std::ios::binary);
  file.read(header.data(), header.size());
  if (!file || std::string_view(header.data(), 4) != "\x89PNG" || header[kBits] != 8) return "";
  std::ostringstream text;
  text << path << ": the depth has 8 bits: steps of " << 1e3 / units_per_metre
       << " mm, and nothing beyond " << 255e3 / units_per_metre
       << " mm; what was measured finer or farther is lost, expected pictures of 16 bits";
  return text.str();
}

Status SetSizeFromPictures(const std::vector<SequenceEntry>& entries, PinholeCamera* camera) {
  Status first_error = Status::Ok();
  for (const SequenceEntry& entry : entries) {
    const StatusOr<std::pair<int, int>> size = ReadPictureSize(entry.depth.path);
    if (size.ok()) {
      camera->width = size->first;
      camera->height = size->second;
      return Status::Ok();
    }
    if (first_error.ok()) first_error = size.status();
  }
  CHECK(!first_error.ok()) << "a sequence has at least one frame";
  return first_error;
}

std::optional<double> TimeInName(const std::string& stem) {
  constexpr std::size_t kFewestDigits = 11;
  const std::size_t dot = stem.find('.');
  const bool is_number = !stem.empty() &&
                         stem.find_first_not_of("0123456789.") == std::string::npos && dot != 0 &&
                         dot + 1 != stem.size() && stem.find('.', dot + 1) == std::string::npos;
  if (!is_number) return std::nullopt;
  // Digits that begin with 0 are a padded number.
  const bool is_whole = dot == std::string::npos;
  if (is_whole && (stem.size() < kFewestDigits || stem[0] == '0')) return std::nullopt;
  const std::optional<double> number = ParseDouble(stem);
  if (!number.has_value() || !is_whole) return number;
  // Times of this century have 10 digits of seconds.
  double unit = 1e-3;
  for (std::size_t digits = 15; digits < stem.size(); digits += 3) unit *= 1e-3;
  return *number * unit;
}

StatusOr<std::map<int, std::string>> ListNumberedPictures(const std::string& folder,
                                                          bool lossless_only,
                                                          std::vector<std::string>* warnings,
                                                          std::vector<double>* times) {
  std::error_code error;
  std::vector<fs::path> names;
  fs::directory_iterator file(folder, error);
  for (; !error && file != fs::directory_iterator(); file.increment(error)) {
    const fs::path name = file->path().filename();
    const std::string extension = Lowercase(name.extension().string());
    const bool is_picture =
        extension == ".png" || (!lossless_only && (extension == ".jpg" || extension == ".jpeg"));
    // Some systems create a hidden copy of every file.
    const bool is_hidden = name.string()[0] == '.';
    if (is_picture && !is_hidden && IsFile(file->path().string())) names.push_back(name);
  }
  if (error) return Status::Error(folder + ": cannot be listed: " + error.message());
  std::sort(names.begin(), names.end());
  if (times != nullptr && AreTimes(names)) return NumberByTime(folder, names, times);

  std::map<int, std::string> pictures;
  int num_without_number = 0;
  for (const fs::path& name : names) {
    const std::optional<int> number = FrameNumber(name);
    if (!number.has_value()) {
      ++num_without_number;
      continue;
    }
    const auto [entry, is_new] = pictures.emplace(*number, JoinPath(folder, name.string()));
    if (!is_new) {
      return Status::Error(entry->second + ": frame " + std::to_string(*number) + " is in " +
                           Quoted(name.string()) + " too, expected one file a frame");
    }
  }
  if (num_without_number > 0) {
    warnings->push_back(folder + ": names of " + std::to_string(num_without_number) +
                        " pictures do not end in a frame number; they are left out");
  }
  return pictures;
}

StatusOr<SequenceListing> ListPictureFolders(const PictureFolders& folders) {
  if (!IsFolder(folders.depth)) {
    return Status::Error(folders.depth + ": no such folder, expected depth pictures in it");
  }
  SequenceListing listing;
  std::vector<double> times;
  const auto list = [&](const std::string& folder, bool lossless_only) {
    using Pictures = std::map<int, std::string>;
    if (!IsFolder(folder)) return StatusOr<Pictures>(Pictures());
    return ListNumberedPictures(folder, lossless_only, &listing.warnings, &times);
  };
  const StatusOr<std::map<int, std::string>> depths = list(folders.depth, true);
  if (!depths.ok()) return depths.status();
  if (depths->empty()) {
    return Status::Error(folders.depth + ": no depth, expected at least one NNNNNN.png of 16 bits");
  }
  const StatusOr<std::map<int, std::string>> colors = list(folders.color, false);
  if (!colors.ok()) return colors.status();
  const StatusOr<std::map<int, std::string>> masks = list(folders.mask, false);
  if (!masks.ok()) return masks.status();

  for (const auto& [number, path] : *depths) {
    SequenceEntry entry;
    entry.number = number;
    entry.time_s = times.empty() ? number : times[static_cast<std::size_t>(number)];
    entry.depth.path = path;
    entry.color.path = PathOf(*colors, number);
    entry.mask.path = PathOf(*masks, number);
    listing.entries.push_back(std::move(entry));
  }
  listing.has_color = !colors->empty();
  listing.has_masks = !masks->empty();
  return listing;
}

StatusOr<SequenceListing> ListStereoFolders(const PictureFolders& folders) {
  SequenceListing listing;
  using Pictures = std::map<int, std::string>;
  std::vector<double> times;
  const auto list = [&](const std::string& folder, bool lossless_only) {
    if (!IsFolder(folder)) return StatusOr<Pictures>(Pictures());
    return ListNumberedPictures(folder, lossless_only, &listing.warnings, &times);
  };
  Pictures lefts, rights;
  const std::pair<const std::string*, Pictures*> sides[] = {{&folders.color, &lefts},
                                                            {&folders.right, &rights}};
  for (const auto& [folder, pictures] : sides) {
    if (!IsFolder(*folder)) {
      return Status::Error(*folder + ": no such folder, expected pictures of one camera in it");
    }
    StatusOr<Pictures> found = list(*folder, false);
    if (!found.ok()) return found.status();
    if (found->empty()) {
      return Status::Error(*folder +
                           ": no picture, expected at least one NNNNNN.png or NNNNNN.jpg");
    }
    *pictures = *std::move(found);
  }
  const StatusOr<Pictures> depths = list(folders.depth, true);
  if (!depths.ok()) return depths.status();
  const StatusOr<Pictures> masks = list(folders.mask, false);
  if (!masks.ok()) return masks.status();

  std::size_t with_depth = 0;
  for (const auto& [number, path] : lefts) {
    if (rights.count(number) == 0) continue;
    SequenceEntry entry;
    entry.number = number;
    entry.time_s = times.empty() ? number : times[static_cast<std::size_t>(number)];
    entry.color.path = path;
    entry.right.path = rights[number];
    entry.mask.path = PathOf(*masks, number);
    entry.depth.path = PathOf(*depths, number);
    with_depth += entry.depth.empty() ? 0 : 1;
    listing.entries.push_back(std::move(entry));
  }
  if (listing.entries.empty()) {
    return Status::Error(folders.color + ": no frame number is in " + Quoted(folders.right) +
                         " too, expected pairs with the same number");
  }
  const std::size_t alone = lefts.size() + rights.size() - 2 * listing.entries.size();
  if (alone > 0) {
    listing.warnings.push_back(folders.color + ": " + std::to_string(alone) +
                               " left or right pictures have no partner of the same number; they "
                               "are left out");
  }
  if (with_depth < listing.entries.size()) {
    for (SequenceEntry& entry : listing.entries) entry.depth = {};
  }
  listing.has_color = true;
  listing.has_masks = !masks->empty();
  return listing;
}

Status SetSizeFromPicture(const SequenceListing& listing, StereoRig* rig) {
  Status first_error = Status::Ok();
  for (const SequenceEntry& entry : listing.entries) {
    const StatusOr<ColorImage> picture = ReadColor(entry.color);
    if (!picture.ok()) {
      if (first_error.ok()) first_error = picture.status();
      continue;
    }
    for (PinholeCamera* camera : {&rig->left.pinhole, &rig->right.pinhole}) {
      camera->width = picture->width();
      camera->height = picture->height();
      // The centre of an endoscope's picture is near the principal point.
      const double du = std::abs(camera->cx / camera->width - 0.5);
      const double dv = std::abs(camera->cy / camera->height - 0.5);
      if (std::max(du, dv) <= 0.5) continue;
      return Status::Error(entry.color.path + ": " + std::to_string(camera->width) + " x " +
                           std::to_string(camera->height) +
                           " pixels, and the calibration has its "
                           "principal point at (" +
                           std::to_string(std::lround(camera->cx)) + ", " +
                           std::to_string(std::lround(camera->cy)) +
                           "), expected the calibration of pictures of this size");
    }
    return Status::Ok();
  }
  CHECK(!first_error.ok()) << "a sequence has at least one frame";
  return first_error;
}

Status AddPosesFile(const std::string& path, SequenceListing* listing) {
  if (!IsFile(path)) return Status::Ok();
  const StatusOr<std::vector<FramePose>> poses = ReadPosesFile(path);
  if (!poses.ok()) return poses.status();
  std::map<int, const CameraPose*> pose_of_frame;
  for (const FramePose& pose : *poses) pose_of_frame[pose.frame] = &pose.world_from_camera;
  for (SequenceEntry& entry : listing->entries) {
    const auto pose = pose_of_frame.find(entry.number);
    if (pose != pose_of_frame.end()) entry.world_from_camera = *pose->second;
  }
  listing->has_poses = true;
  return Status::Ok();
}

}  // namespace ceres_ed
