#include "ceres_ed/io/sequence/layouts/surgt_truth.h"

#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/text_rows.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>

namespace ceres_ed {
namespace {

using nlohmann::json;

// Returns a box of four finite numbers.
std::optional<PictureBox> BoxOf(const json& value) {
  if (!value.is_array() || value.size() != 4) return std::nullopt;
  double numbers[4];
  for (std::size_t i = 0; i < 4; ++i) {
    if (!value[i].is_number()) return std::nullopt;
    numbers[i] = value[i].get<double>();
    if (!std::isfinite(numbers[i])) return std::nullopt;
  }
  return PictureBox{numbers[0], numbers[1], numbers[2], numbers[3]};
}

Status AddFrame(const std::string& path, int frame, const json& value, BoxTrack* track) {
  const auto bad = [&] {
    return Status::Error(path + ": frame " + std::to_string(frame) +
                         " is no annotation, expected [visible, difficult, [[u, v, width, height], "
                         "[u, v, width, height]]], or null in the place of the boxes");
  };
  if (!value.is_array() || value.size() != 3 || !value[0].is_boolean() || !value[1].is_boolean()) {
    return bad();
  }
  if (!value[0].get<bool>() || value[2].is_null()) return Status::Ok();
  if (!value[2].is_array() || value[2].size() != 2) return bad();
  const std::optional<PictureBox> left = BoxOf(value[2][0]);
  const std::optional<PictureBox> right = BoxOf(value[2][1]);
  if (!left.has_value() || !right.has_value()) return bad();
  track->boxes[frame] = {*left, *right, value[1].get<bool>()};
  return Status::Ok();
}

StatusOr<BoxTrack> ReadTrack(const std::string& path) {
  const StatusOr<json> file = ReadYamlFile(path);
  if (!file.ok()) return file.status();
  BoxTrack track;
  track.name = std::filesystem::path(path).filename().string();
  if (file->is_array()) {
    for (std::size_t i = 0; i < file->size(); ++i) {
      Status status = AddFrame(path, static_cast<int>(i), (*file)[i], &track);
      if (!status.ok()) return status;
    }
    return track;
  }
  if (!file->is_object()) {
    return Status::Error(path + ": no list of frames, expected one annotation a frame");
  }
  for (const auto& [key, value] : file->items()) {
    const StatusOr<int> frame = ParseNatural(path + ": ", "frame", key);
    if (!frame.ok()) return frame.status();
    Status status = AddFrame(path, *frame, value, &track);
    if (!status.ok()) return status;
  }
  return track;
}

std::string Text(const PictureBox& box) {
  std::string text;
  for (const double number : {box.u, box.v, box.width, box.height}) {
    text += text.empty() ? "[" : ", ";
    AppendNumbers({number}, &text);
  }
  return text + "]";
}

}  // namespace

StatusOr<std::vector<BoxTrack>> ReadSurgTBoxes(const std::string& directory) {
  std::vector<BoxTrack> tracks;
  for (const std::string& name : FileNames(directory)) {
    const bool is_truth =
        name.rfind("gt_rectified_", 0) == 0 && std::filesystem::path(name).extension() == ".yaml";
    if (!is_truth) continue;
    StatusOr<BoxTrack> track = ReadTrack(JoinPath(directory, name));
    if (!track.ok()) return track.status();
    tracks.push_back(*std::move(track));
  }
  return tracks;
}

std::string BoxTrackText(const BoxTrack& track, int num_frames) {
  std::string text;
  for (int frame = 0; frame < num_frames; ++frame) {
    const auto box = track.boxes.find(frame);
    text += box == track.boxes.end() ? std::string("- [false, false, null]\n")
                                     : "- [true, false, [" + Text(box->second.left) + ", " +
                                           Text(box->second.right) + "]]\n";
  }
  return text;
}

}  // namespace ceres_ed
