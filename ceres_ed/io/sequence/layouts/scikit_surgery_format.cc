#include "ceres_ed/io/sequence/sequence_format.h"

#include <ceres_ed/io/sequence/layouts/matrix_file.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/picture_reader.h>
#include <ceres_ed/io/sequence/sequence_listing.h>

#include <cstdio>
#include <optional>

namespace ceres_ed {
namespace {

constexpr double kMetresPerMillimetre = 1e-3;

StatusOr<LensCamera> ReadLens(const std::string& directory, const std::string& side) {
  const StatusOr<PinholeCamera> pinhole =
      ReadCameraMatrix(JoinPath(directory, "calib." + side + ".intrinsic.txt"));
  if (!pinhole.ok()) return pinhole.status();
  LensCamera lens;
  lens.pinhole = *pinhole;
  const std::string path = JoinPath(directory, "calib." + side + ".distortion.txt");
  if (!IsFile(path)) return lens;
  const StatusOr<std::array<double, 8>> distortion = ReadDistortionFile(path);
  if (!distortion.ok()) return distortion.status();
  lens.distortion = *distortion;
  return lens;
}

std::string Text(double metres) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g mm", metres / kMetresPerMillimetre);
  return text;
}

// Reads a transform whose translation is in millimetres; nothing if there is no such file.
StatusOr<std::optional<RigidTransform>> ReadTransform(const std::string& path) {
  if (!IsFile(path)) return std::optional<RigidTransform>();
  const StatusOr<RigidTransform> transform = ReadTransformMatrix(path, kMetresPerMillimetre);
  if (!transform.ok()) return transform.status();
  const double baseline = transform->translation.norm();
  if (baseline < 1e-4 || baseline > 1.0) {
    return Status::Error(path + ": the cameras are " + Text(baseline) +
                         " apart, expected a translation in millimetres");
  }
  return std::optional<RigidTransform>(*transform);
}

// Returns right_from_left from calib.l2r.txt, or from the inverse calib.r2l.txt. Where both are
// there they must agree, and where the right camera would be at the left of the left one, a file is
// the wrong way round.
StatusOr<RigidTransform> ReadRightFromLeft(const std::string& directory) {
  const std::string l2r = JoinPath(directory, "calib.l2r.txt");
  const std::string r2l = JoinPath(directory, "calib.r2l.txt");
  const StatusOr<std::optional<RigidTransform>> forward = ReadTransform(l2r);
  if (!forward.ok()) return forward.status();
  const StatusOr<std::optional<RigidTransform>> backward = ReadTransform(r2l);
  if (!backward.ok()) return backward.status();
  if (!forward->has_value() && !backward->has_value()) {
    return Status::Error(l2r +
                         ": not there, expected it or calib.r2l.txt: the transform between the "
                         "cameras, 4 x 4 numbers, millimetres");
  }
  const RigidTransform transform = forward->has_value() ? **forward : (*backward)->Inverse();
  if (forward->has_value() && backward->has_value()) {
    const RigidTransform rest = transform * **backward;
    if (rest.translation.norm() > 0.1 * transform.translation.norm()) {
      return Status::Error(l2r +
                           ": is not the inverse of calib.r2l.txt, expected one of them to be "
                           "removed, or both to belong together");
    }
  }
  if (transform.translation.x() > 0.0) {
    const std::string& used = forward->has_value() ? l2r : r2l;
    return Status::Error(
        used + ": by it the right camera is " + Text(transform.translation.x()) +
        " at the left of the left one; it is the wrong way round, expected the name " +
        (forward->has_value() ? "calib.r2l.txt" : "calib.l2r.txt") +
        " for it (or left and right swapped, if the calibration calls the cameras so)");
  }
  return transform;
}

}  // namespace

bool IsScikitSurgerySequence(const std::string& directory) {
  return IsFile(JoinPath(directory, "calib.left.intrinsic.txt"));
}

StatusOr<SequenceListing> ListScikitSurgerySequence(const std::string& directory) {
  const StatusOr<LensCamera> left = ReadLens(directory, "left");
  if (!left.ok()) return left.status();
  const StatusOr<LensCamera> right = ReadLens(directory, "right");
  if (!right.ok()) return right.status();
  const StatusOr<RigidTransform> right_from_left = ReadRightFromLeft(directory);
  if (!right_from_left.ok()) return right_from_left.status();
  PictureFolders folders;
  folders.color = JoinPath(directory, "left");
  folders.right = JoinPath(directory, "right");
  folders.mask = JoinPath(directory, "mask");
  StatusOr<SequenceListing> listing = ListStereoFolders(folders);
  if (!listing.ok()) return listing.status();
  listing->rig = StereoRig{*left, *right, *right_from_left};
  // The calibration does not give the size of its pictures.
  Status status = SetSizeFromPicture(*listing, &*listing->rig);
  if (!status.ok()) return status;
  listing->camera.camera = listing->rig->left.pinhole;
  status = AddPosesFile(JoinPath(directory, "poses.txt"), &*listing);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
