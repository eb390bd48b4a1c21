#include "ceres_ed/io/sequence/sequence_format.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/io/text_rows.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <tuple>
#include <utility>

namespace ceres_ed {
namespace {

constexpr double kUnitsPerMetre = 5000.0;
// The limit of the benchmark's own tool, in seconds.
constexpr double kMaxTimeDifference = 0.02;

// An image and its time in seconds.
struct TimedFile {
  double time_s = 0.0;
  std::string path;
};

// Returns the rows `timestamp filename` of a list by ascending time, with each time once.
StatusOr<std::vector<TimedFile>> ReadFileList(const std::string& directory, const char* name) {
  const std::string path = JoinPath(directory, name);
  std::vector<TimedFile> files;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    if (row.fields.size() != 2) {
      return Status::Error(row.place + std::to_string(row.fields.size()) +
                           (row.fields.size() == 1 ? " field" : " fields") +
                           ", expected 2: timestamp filename");
    }
    const StatusOr<double> time_s = ParseFinite(row.place, "timestamp", row.fields[0]);
    if (!time_s.ok()) return time_s.status();
    files.push_back({*time_s, JoinPath(directory, std::string(row.fields[1]))});
    return Status::Ok();
  });
  if (!status.ok()) return status;
  std::stable_sort(files.begin(), files.end(), [](const TimedFile& a, const TimedFile& b) {
    return a.time_s < b.time_s;
  });
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (files[i].time_s == files[i - 1].time_s) {
      return Status::Error(path + ": '" + files[i - 1].path + "' and '" + files[i].path +
                           "' have the same timestamp, expected one picture a moment");
    }
  }
  return files;
}

// Assigns to each entry the colour image nearest in time, and each image to at most one entry. The
// closest pairs are assigned first, as in the benchmark's own tool. Both lists are ascending in
// time.
void AssociateColors(const std::vector<TimedFile>& colors, std::vector<SequenceEntry>* entries) {
  // Time difference, entry, colour.
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const double time_s = (*entries)[i].time_s;
    while (begin < colors.size() && colors[begin].time_s <= time_s - kMaxTimeDifference) ++begin;
    for (std::size_t j = begin; j < colors.size(); ++j) {
      const double difference = std::abs(colors[j].time_s - time_s);
      if (difference >= kMaxTimeDifference) break;
      pairs.emplace_back(difference, i, j);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> is_taken(colors.size(), false);
  for (const auto& [difference, i, j] : pairs) {
    if (is_taken[j] || !(*entries)[i].color.empty()) continue;
    is_taken[j] = true;
    (*entries)[i].color.path = colors[j].path;
  }
}

// Assigns to each entry the pose nearest in time; of two equally near ones the earlier one.
Status AddPoses(const std::string& path, SequenceListing* listing) {
  StatusOr<std::vector<TimedPose>> poses = ReadTrajectory(path);
  if (!poses.ok()) return poses.status();
  std::stable_sort(poses->begin(), poses->end(), [](const TimedPose& a, const TimedPose& b) {
    return a.time_s < b.time_s;
  });
  for (SequenceEntry& entry : listing->entries) {
    auto next = std::lower_bound(
        poses->begin(), poses->end(), entry.time_s, [](const TimedPose& pose, double time_s) {
          return pose.time_s < time_s;
        });
    const bool earlier_is_nearer =
        next != poses->begin() && (next == poses->end() || entry.time_s - std::prev(next)->time_s <=
                                                               next->time_s - entry.time_s);
    if (earlier_is_nearer) --next;
    if (next != poses->end() && std::abs(next->time_s - entry.time_s) < kMaxTimeDifference) {
      entry.world_from_camera = next->world_from_camera;
    }
  }
  listing->has_poses = true;
  return Status::Ok();
}

// Returns the name of the folder, also for "." or "a/b/".
std::string FolderName(const std::string& directory) {
  std::error_code ignored;
  return std::filesystem::canonical(directory, ignored).filename().string();
}

// Returns the intrinsics that the benchmark's web page gives for its sensors. Lens distortion is
// ignored.
PinholeCamera DefaultIntrinsics(const std::string& directory, std::vector<std::string>* warnings) {
  struct Sensor {
    const char* name;
    const char* short_name;
    PinholeCamera camera;
  };
  static const Sensor kSensors[] = {
      {"freiburg1", "fr1", {517.3, 516.5, 318.6, 255.3, 0, 0}},
      {"freiburg2", "fr2", {520.9, 521.0, 325.1, 249.7, 0, 0}},
      {"freiburg3", "fr3", {535.4, 539.2, 320.1, 247.6, 0, 0}},
  };
  const std::string folder = FolderName(directory);
  for (const Sensor& sensor : kSensors) {
    const bool is_named = folder.find(sensor.name) != std::string::npos ||
                          folder.find(sensor.short_name) != std::string::npos;
    if (is_named) return sensor.camera;
  }
  warnings->push_back(JoinPath(directory, "camera.txt") +
                      ": not there, and the folder's name tells no sensor (freiburg1, 2 or 3); "
                      "fx fy cx cy are taken as 525 525 319.5 239.5");
  return {525.0, 525.0, 319.5, 239.5, 0, 0};
}

Status SetCamera(const std::string& directory, SequenceListing* listing) {
  const std::string path = JoinPath(directory, "camera.txt");
  if (IsFile(path)) {
    const StatusOr<CameraFile> camera = ReadCameraFile(path);
    if (!camera.ok()) return camera.status();
    listing->camera = *camera;
    return Status::Ok();
  }
  listing->camera = {DefaultIntrinsics(directory, &listing->warnings), kUnitsPerMetre};
  PinholeCamera& camera = listing->camera.camera;
  Status status = SetSizeFromPictures(listing->entries, &camera);
  if (!status.ok()) return status;
  if (camera.width != 640 || camera.height != 480) {
    listing->warnings.push_back(
        path + ": not there, and the pictures have " + std::to_string(camera.width) + " x " +
        std::to_string(camera.height) + " pixels; the intrinsics assumed are those of 640 x 480");
  }
  return Status::Ok();
}

}  // namespace

bool IsTumSequence(const std::string& directory) {
  return IsFile(JoinPath(directory, "depth.txt"));
}

StatusOr<SequenceListing> ListTumSequence(const std::string& directory) {
  const StatusOr<std::vector<TimedFile>> depths = ReadFileList(directory, "depth.txt");
  if (!depths.ok()) return depths.status();
  SequenceListing listing;
  for (std::size_t i = 0; i < depths->size(); ++i) {
    const TimedFile& depth = (*depths)[i];
    // A missing file leaves a gap: the other frames keep their numbers in the list.
    if (!IsFile(depth.path)) continue;
    SequenceEntry entry;
    entry.number = static_cast<int>(i);
    entry.time_s = depth.time_s;
    entry.depth.path = depth.path;
    listing.entries.push_back(std::move(entry));
  }
  const std::string list_path = JoinPath(directory, "depth.txt");
  if (listing.entries.empty()) {
    return Status::Error(list_path + ": no depth: names " + std::to_string(depths->size()) +
                         " files, none of which is there, expected at least one");
  }
  if (listing.entries.size() < depths->size()) {
    listing.warnings.push_back(list_path + ": " +
                               std::to_string(depths->size() - listing.entries.size()) + " of " +
                               std::to_string(depths->size()) + " files are not there");
  }
  if (IsFile(JoinPath(directory, "rgb.txt"))) {
    StatusOr<std::vector<TimedFile>> colors = ReadFileList(directory, "rgb.txt");
    if (!colors.ok()) return colors.status();
    AssociateColors(*colors, &listing.entries);
    for (SequenceEntry& entry : listing.entries) {
      if (!IsFile(entry.color.path)) entry.color = {};
    }
    listing.has_color = !colors->empty();
  }
  const std::string poses_path = JoinPath(directory, "groundtruth.txt");
  if (IsFile(poses_path)) {
    Status status = AddPoses(poses_path, &listing);
    if (!status.ok()) return status;
  }
  Status status = SetCamera(directory, &listing);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
