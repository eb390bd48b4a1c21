#include "ceres_ed/pipeline/slam/challenge.h"

#include <ceres_ed/evaluation/layout_truth.h>
#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/sequence/layouts/stir_truth.h>
#include <ceres_ed/io/text_rows.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

constexpr double kMillimetresPerMetre = 1000.0;

// The place of a point in a frame.
struct Place {
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
  bool visible = false;
};

// Places by frame and point.
using Places = std::map<int, std::map<int, Place>>;

// Reads frame,id,x,y,z,visible.
StatusOr<Places> ReadTracks(const std::string& path) {
  Places places;
  Status status = ForEachTextRow(path, [&places](const TextRow& row) {
    if (row.fields[0] == "frame") return Status::Ok();
    constexpr std::size_t kColumns = 6;
    if (row.fields.size() != kColumns) {
      return Status::Error(row.place + std::to_string(row.fields.size()) + " columns, expected 6");
    }
    double numbers[kColumns];
    for (std::size_t i = 0; i < kColumns; ++i) {
      const StatusOr<double> number = ParseFinite(row.place, "a column", row.fields[i]);
      if (!number.ok()) return number.status();
      numbers[i] = *number;
    }
    places[static_cast<int>(numbers[0])][static_cast<int>(numbers[1])] = {
        {numbers[2], numbers[3], numbers[4]}, numbers[5] != 0.0};
    return Status::Ok();
  });
  if (!status.ok()) return status;
  return places;
}

// Returns the depth of the pixel nearest to `pixel` that has depth, within 15 pixels.
std::optional<double> DepthNear(const DepthImage& depth, const Eigen::Vector2d& pixel) {
  constexpr int kRadius = 15;
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  std::optional<double> nearest;
  int nearest_distance = kRadius * kRadius + 1;
  for (int dv = -kRadius; dv <= kRadius; ++dv) {
    for (int du = -kRadius; du <= kRadius; ++du) {
      if (!depth.Contains(u + du, v + dv) || !(depth(u + du, v + dv) > 0.0F)) continue;
      const int distance = du * du + dv * dv;
      if (distance >= nearest_distance) continue;
      nearest_distance = distance;
      nearest = depth(u + du, v + dv);
    }
  }
  return nearest;
}

// Returns the first frame that can be read, and its number.
StatusOr<DepthFrame> FirstFrame(const DepthSource& source) {
  Status first_error = Status::Ok();
  for (int i = 0; i < source.num_frames(); ++i) {
    StatusOr<DepthFrame> frame = source.Load(i);
    if (frame.ok()) return frame;
    if (first_error.ok()) first_error = frame.status();
  }
  return first_error;
}

Status NoAnnotation(const std::string& input, const char* expected) {
  return Status::Error(input + ": no annotation of a challenge, expected " + expected);
}

}  // namespace

StatusOr<ChallengePoints> ChallengePoints::Load(const SlamSettings& settings,
                                                const DepthSource& source,
                                                WarningLog* warnings) {
  ChallengePoints result;
  result.challenge_ = settings.predict;
  if (settings.predict == Challenge::kNone) return result;
  const StatusOr<DepthFrame> frame = FirstFrame(source);
  if (!frame.ok()) return frame.status();
  result.first_frame_ = frame->number;
  if (settings.predict == Challenge::kStir) {
    const StatusOr<std::optional<StirPoints>> points = ReadStirPoints(settings.input);
    if (!points.ok()) return points.status();
    if (!points->has_value()) {
      return NoAnnotation(settings.input, "segmentation/icgstartseg.png in a clip of STIR");
    }
    result.name_ = (*points)->clip;
    result.pixels_ = (*points)->start;
  } else {
    StatusOr<std::vector<BoxTrack>> boxes = ReadSurgTBoxes(settings.input);
    if (!boxes.ok()) return boxes.status();
    const AnnotatedCamera annotated = SurgTCamera(source);
    for (BoxTrack& track : *boxes) {
      const auto box = track.boxes.find(frame->number);
      if (box == track.boxes.end()) {
        warnings->Add("predict",
                      track.name + ": has no box in frame " + std::to_string(frame->number) +
                          " and is not predicted");
        continue;
      }
      result.pixels_.push_back(
          PixelOfRay(box->second.left.center(), annotated.camera, source.camera()));
      result.boxes_.push_back(std::move(track));
    }
    if (result.boxes_.empty()) {
      return NoAnnotation(settings.input, "gt_rectified_N.yaml with a box in the first frame");
    }
  }
  for (std::size_t i = 0; i < result.pixels_.size(); ++i) {
    const Eigen::Vector2d& pixel = result.pixels_[i];
    const std::optional<double> depth = DepthNear(frame->depth, pixel);
    if (!depth.has_value()) {
      warnings->Add("predict",
                    "point " + std::to_string(i) +
                        " has no depth near it in the first frame, and follows the "
                        "nearest point that has");
      continue;
    }
    result.points_.push_back(
        {static_cast<int>(i), source.camera().BackProject(pixel.x(), pixel.y(), *depth)});
  }
  if (result.points_.empty()) {
    return Status::Error(settings.input + ": none of the " + std::to_string(result.pixels_.size()) +
                         " points of the challenge has depth in the first frame");
  }
  return result;
}

Status ChallengePoints::Write(const std::string& folder, const DepthSource& source) const {
  switch (challenge_) {
    case Challenge::kNone:
      return Status::Ok();
    case Challenge::kStir:
      return WriteStir(folder, source);
    case Challenge::kSurgT:
      return WriteSurgT(folder, source);
  }
  return Status::Ok();
}

Status ChallengePoints::WriteStir(const std::string& folder, const DepthSource& source) const {
  const StatusOr<Places> places = ReadTracks(folder + "/tracks.csv");
  if (!places.ok()) return places.status();
  if (places->empty()) {
    return Status::Error(folder + "/tracks.csv: no row, expected the points of the challenge");
  }
  const PinholeCamera& camera = source.camera();
  // Each point follows itself, or the nearest point that was tracked.
  const auto leader = [&](std::size_t point) {
    int nearest = -1;
    for (const auto& [id, place] : places->rbegin()->second) {
      const Eigen::Vector2d& pixel = pixels_[static_cast<std::size_t>(id)];
      const bool is_nearer =
          nearest < 0 || (pixel - pixels_[point]).norm() <
                             (pixels_[static_cast<std::size_t>(nearest)] - pixels_[point]).norm();
      if (is_nearer) nearest = id;
    }
    return nearest;
  };
  ordered_json last_2d = ordered_json::array();
  ordered_json last_3d = ordered_json::array();
  ordered_json tracks = ordered_json::array();
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const int id = leader(i);
    const Eigen::Vector2d shift = pixels_[i] - pixels_[static_cast<std::size_t>(id)];
    ordered_json frames = ordered_json::array();
    for (const auto& [frame, of_frame] : *places) {
      const auto found = of_frame.find(id);
      if (found == of_frame.end() || !(found->second.in_camera.z() > 0.0)) continue;
      const Eigen::Vector3d& tracked = found->second.in_camera;
      const Eigen::Vector2d pixel = camera.Project(tracked) + shift;
      const Eigen::Vector3d point =
          kMillimetresPerMetre * camera.BackProject(pixel.x(), pixel.y(), tracked.z());
      frames.push_back({{"frame", frame},
                        {"pixel", {pixel.x(), pixel.y()}},
                        {"mm", {point.x(), point.y(), point.z()}},
                        {"visible", found->second.visible}});
    }
    if (frames.empty()) continue;
    last_2d.push_back(frames.back()["pixel"]);
    last_3d.push_back(frames.back()["mm"]);
    tracks.push_back({{"start", {pixels_[i].x(), pixels_[i].y()}}, {"frames", frames}});
  }
  for (const auto& [file, value] : {std::pair("stir_2d.json", &last_2d),
                                    std::pair("stir_3d.json", &last_3d),
                                    std::pair("stir_tracks.json", &tracks)}) {
    const ordered_json contents = {{name_, *value}};
    Status status = WriteFileAtomically(folder + "/" + file, contents.dump() + "\n");
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

Status ChallengePoints::WriteSurgT(const std::string& folder, const DepthSource& source) const {
  const StatusOr<Places> places = ReadTracks(folder + "/tracks.csv");
  if (!places.ok()) return places.status();
  const AnnotatedCamera annotated = SurgTCamera(source);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const PictureBox start = boxes_[i].boxes.at(first_frame_).left;
    BoxTrack predicted;
    double start_depth = 0.0;
    for (const auto& [frame, of_frame] : *places) {
      const auto found = of_frame.find(static_cast<int>(i));
      if (found == of_frame.end() || !(found->second.in_camera.z() > 0.0)) continue;
      const Eigen::Vector3d& point = found->second.in_camera;
      if (start_depth == 0.0) start_depth = point.z();
      if (!found->second.visible) continue;
      // The box keeps its size on the tissue.
      const double scale = start_depth / point.z();
      const Eigen::Vector2d center = annotated.camera.Project(point);
      StereoBox box;
      box.left = {center.x() - scale * start.width / 2,
                  center.y() - scale * start.height / 2,
                  scale * start.width,
                  scale * start.height};
      box.right = box.left;
      box.right.u -= annotated.focal_times_baseline / point.z();
      predicted.boxes[frame] = box;
    }
    const std::string name = "pred" + boxes_[i].name.substr(2);
    const int num_frames = places->empty() ? 0 : places->rbegin()->first + 1;
    Status status = WriteFileAtomically(folder + "/" + name, BoxTrackText(predicted, num_frames));
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

}  // namespace ceres_ed
