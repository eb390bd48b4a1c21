#include "ceres_ed/evaluation/layout_truth.h"

#include <ceres_ed/io/calibration/rectify_rig.h>
#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/sequence/layouts/surgt_truth.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <system_error>

namespace ceres_ed {
namespace {

// Appends the middles of boxes.
Status AddBoxes(const std::string& folder,
                const DepthSource& source,
                std::vector<TrackObservation>* tracks) {
  const StatusOr<std::vector<BoxTrack>> boxes = ReadSurgTBoxes(folder);
  if (!boxes.ok()) return boxes.status();
  const AnnotatedCamera annotated = SurgTCamera(source);
  for (std::size_t i = 0; i < boxes->size(); ++i) {
    for (const auto& [frame, box] : (*boxes)[i].boxes) {
      if (box.is_difficult) continue;
      tracks->push_back({frame,
                         static_cast<int>(i),
                         PixelOfRay(box.left.center(), annotated.camera, source.camera())});
    }
  }
  return Status::Ok();
}

// Appends the points of SuPer.
Status AddPoints(const std::string& path,
                 const DepthSource& source,
                 std::vector<TrackObservation>* tracks) {
  const StatusOr<NpyArray> array = ReadNpyFile(path);
  if (!array.ok()) return array.status();
  const std::vector<std::size_t>& shape = array->shape;
  if (shape.size() != 3 || shape[2] != 2) {
    return Status::Error(path + ": the shape is " + array->ShapeText() +
                         ", expected (frames, points, 2)");
  }
  const auto num_frames = std::min(shape[0], static_cast<std::size_t>(source.num_frames()));
  for (std::size_t i = 0; i < num_frames; ++i) {
    for (std::size_t k = 0; k < shape[1]; ++k) {
      const double* pixel = &array->values[2 * (i * shape[1] + k)];
      if (!std::isfinite(pixel[0]) || !std::isfinite(pixel[1])) continue;
      tracks->push_back(
          {source.frame_number(static_cast<int>(i)), static_cast<int>(k), {pixel[0], pixel[1]}});
    }
  }
  return Status::Ok();
}

}  // namespace

AnnotatedCamera SurgTCamera(const DepthSource& source) {
  AnnotatedCamera annotated;
  annotated.camera = source.camera();
  const StereoRig* rig = source.sequence().rig();
  if (rig == nullptr) return annotated;
  const StereoRig rectified = source.sequence().is_rectified() ? *rig : RectifyRig(*rig);
  annotated.camera = rectified.left.pinhole;
  annotated.focal_times_baseline =
      annotated.camera.fx * rectified.right_from_left.translation.norm();
  return annotated;
}

Eigen::Vector2d PixelOfRay(const Eigen::Vector2d& pixel,
                           const PinholeCamera& from,
                           const PinholeCamera& to) {
  return to.Project(from.BackProject(pixel.x(), pixel.y(), 1.0));
}

StatusOr<std::vector<TrackObservation>> ReadLayoutTracks(const std::string& folder,
                                                         const DepthSource& source,
                                                         std::vector<std::string>* warnings) {
  std::vector<TrackObservation> tracks;
  Status status = AddBoxes(folder, source, &tracks);
  if (!status.ok()) return status;
  const std::string points = (std::filesystem::path(folder) / "rgb" / "left_pts.npy").string();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(points, ignored)) return tracks;
  status = AddPoints(points, source, &tracks);
  // Some of these files hold a dictionary.
  if (!status.ok()) {
    warnings->push_back(status.message() +
                        "; its points are not used. With numpy, save them as numbers: "
                        "numpy.save('left_pts.npy', points)");
  }
  return tracks;
}

}  // namespace ceres_ed
