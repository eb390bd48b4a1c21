#include "ceres_ed/io/camera_io.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>

namespace ceres_ed {
namespace {

constexpr std::string_view kCameraFields[] = {
    "fx", "fy", "cx", "cy", "width", "height", "depth_units_per_metre"};
constexpr std::size_t kNumCameraFields = std::size(kCameraFields);
constexpr std::string_view kCameraHeader = "fx fy cx cy width height depth_units_per_metre";

constexpr std::string_view kPoseFields[] = {"tx", "ty", "tz", "qx", "qy", "qz", "qw"};
constexpr std::size_t kNumPoseFields = std::size(kPoseFields);
constexpr char kPoseHeader[] = " tx ty tz qx qy qz qw";

// The largest width and height. It is larger than any sensor, and width * height fits into an int.
constexpr int kMaxSize = 32768;

// Returns what is expected of field `index` of a camera file if it can't have `value`, otherwise an
// empty string.
std::string CameraFieldExpectation(std::size_t index, double value) {
  const std::string_view name = kCameraFields[index];
  if (name == "fx" || name == "fy") return value > 0.0 ? "" : "a focal length > 0 pixels";
  if (name == "cx" || name == "cy") return "";
  if (name == "depth_units_per_metre") return value > 0.0 ? "" : "a number > 0 (1000: millimetres)";
  const bool is_size = value >= 1.0 && value <= kMaxSize && value == std::floor(value);
  return is_size ? "" : "a whole number of pixels from 1 to " + std::to_string(kMaxSize);
}

Status CheckCameraField(const std::string& place,
                        std::size_t index,
                        double value,
                        std::string_view text) {
  const std::string expected = CameraFieldExpectation(index, value);
  if (expected.empty()) return Status::Ok();
  return Status::Error(place + std::string(kCameraFields[index]) + " is " + Quoted(text) +
                       ", expected " + expected);
}

// A quaternion that has unit length up to rounding is not changed, so that it is read back as it
// was written.
StatusOr<CameraPose> MakePose(const std::string& place, const double (&values)[kNumPoseFields]) {
  CameraPose pose;
  pose.translation = {values[0], values[1], values[2]};
  Eigen::Vector4d q(values[3], values[4], values[5], values[6]);
  const double largest = q.cwiseAbs().maxCoeff();
  if (largest == 0.0) {
    return Status::Error(place + "the quaternion is 0 0 0 0, expected one of unit length");
  }
  constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
  if (!(std::abs(q.squaredNorm() - 1.0) <= kRounding)) q = (q / largest).normalized();
  pose.rotation.coeffs() = q;
  return pose;
}

// Reads the pose after the first field, whose name is `first_name`.
StatusOr<CameraPose> ParsePose(const TextRow& row, const std::string& first_name) {
  if (row.fields.size() != kNumPoseFields + 1) {
    return Status::Error(row.place + std::to_string(row.fields.size()) +
                         (row.fields.size() == 1 ? " field" : " fields") +
                         ", expected 8: " + first_name + kPoseHeader);
  }
  double values[kNumPoseFields];
  for (std::size_t i = 0; i < kNumPoseFields; ++i) {
    const StatusOr<double> value = ParseFinite(row.place, kPoseFields[i], row.fields[i + 1]);
    if (!value.ok()) return value.status();
    values[i] = *value;
  }
  return MakePose(row.place, values);
}

// Appends a row with `label` (the frame or time) and the pose.
Status AppendPose(const std::string& path,
                  double label,
                  const CameraPose& pose,
                  std::string* contents) {
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  const bool usable = std::isfinite(label) && t.allFinite() && q.coeffs().allFinite() &&
                      (q.coeffs().array() != 0.0).any();
  if (!usable) {
    return Status::Error(path + ": the pose at " + std::to_string(label) +
                         " is not finite or no rotation, expected one that can be written");
  }
  AppendNumbers({label, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}, contents);
  *contents += '\n';
  return Status::Ok();
}

}  // namespace

StatusOr<CameraFile> ReadCameraFile(const std::string& path) {
  double values[kNumCameraFields];
  std::size_t count = 0;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    for (const std::string_view field : row.fields) {
      if (count == kNumCameraFields) {
        return Status::Error(row.place + Quoted(field) + " behind the seventh number, expected " +
                             "nothing more than " + std::string(kCameraHeader));
      }
      const StatusOr<double> value = ParseFinite(row.place, kCameraFields[count], field);
      if (!value.ok()) return value.status();
      Status in_range = CheckCameraField(row.place, count, *value, field);
      if (!in_range.ok()) return in_range;
      values[count++] = *value;
    }
    return Status::Ok();
  });
  if (!status.ok()) return status;
  if (count != kNumCameraFields) {
    return Status::Error(path + ": " + std::to_string(count) +
                         (count == 1 ? " number" : " numbers") +
                         ", expected 7: " + std::string(kCameraHeader));
  }
  CameraFile file;
  file.camera = {values[0],
                 values[1],
                 values[2],
                 values[3],
                 static_cast<int>(values[4]),
                 static_cast<int>(values[5])};
  file.depth_units_per_metre = values[6];
  return file;
}

Status WriteCameraFile(const std::string& path, const CameraFile& file) {
  const PinholeCamera& camera = file.camera;
  const double values[kNumCameraFields] = {camera.fx,
                                           camera.fy,
                                           camera.cx,
                                           camera.cy,
                                           static_cast<double>(camera.width),
                                           static_cast<double>(camera.height),
                                           file.depth_units_per_metre};
  std::string contents = "# " + std::string(kCameraHeader) + "\n";
  for (std::size_t i = 0; i < kNumCameraFields; ++i) {
    std::string text;
    AppendNumbers({values[i]}, &text);
    const StatusOr<double> finite = ParseFinite(path + ": ", kCameraFields[i], text);
    if (!finite.ok()) return finite.status();
    Status in_range = CheckCameraField(path + ": ", i, values[i], text);
    if (!in_range.ok()) return in_range;
    contents += text + (i + 1 == kNumCameraFields ? "\n" : " ");
  }
  return WriteFileAtomically(path, contents);
}

StatusOr<std::vector<FramePose>> ReadPosesFile(const std::string& path) {
  std::vector<FramePose> poses;
  std::set<int> frames;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    const StatusOr<int> frame = ParseNatural(row.place, "frame", row.fields[0]);
    if (!frame.ok()) return frame.status();
    const StatusOr<CameraPose> pose = ParsePose(row, "frame");
    if (!pose.ok()) return pose.status();
    if (!frames.insert(*frame).second) {
      return Status::Error(row.place + "frame " + std::to_string(*frame) +
                           " is there a second time, expected one row a frame");
    }
    poses.push_back({*frame, *pose});
    return Status::Ok();
  });
  if (!status.ok()) return status;
  return poses;
}

Status WritePosesFile(const std::string& path, const std::vector<FramePose>& poses) {
  std::string contents = std::string("# frame") + kPoseHeader + ", camera to world, metres\n";
  for (const FramePose& pose : poses) {
    Status status = AppendPose(path, pose.frame, pose.world_from_camera, &contents);
    if (!status.ok()) return status;
  }
  return WriteFileAtomically(path, contents);
}

StatusOr<std::vector<TimedPose>> ReadTrajectory(const std::string& path) {
  std::vector<TimedPose> poses;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    const StatusOr<double> time_s = ParseFinite(row.place, "timestamp", row.fields[0]);
    if (!time_s.ok()) return time_s.status();
    const StatusOr<CameraPose> pose = ParsePose(row, "timestamp");
    if (!pose.ok()) return pose.status();
    poses.push_back({*time_s, *pose});
    return Status::Ok();
  });
  if (!status.ok()) return status;
  return poses;
}

Status WriteTrajectory(const std::string& path, const std::vector<TimedPose>& poses) {
  std::string contents = std::string("# timestamp") + kPoseHeader + ", seconds and metres\n";
  for (const TimedPose& pose : poses) {
    Status status = AppendPose(path, pose.time_s, pose.world_from_camera, &contents);
    if (!status.ok()) return status;
  }
  return WriteFileAtomically(path, contents);
}

}  // namespace ceres_ed
