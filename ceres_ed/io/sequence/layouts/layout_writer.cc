#include "ceres_ed/io/sequence/layouts/layout_writer.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/io/video/video_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// The rate of the videos; no layout depends on it.
constexpr double kFramesPerSecond = 25.0;
constexpr double kMillimetresPerMetre = 1000.0;

// Returns a matrix as OpenCV writes it in YAML.
std::string OpenCvMatrix(const std::string& name, const Eigen::MatrixXd& matrix) {
  std::string data;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      if (!data.empty()) data += ", ";
      AppendNumbers({matrix(row, column)}, &data);
    }
  }
  return name + ": !!opencv-matrix\n   rows: " + std::to_string(matrix.rows()) +
         "\n   cols: " + std::to_string(matrix.cols()) + "\n   dt: d\n   data: [ " + data + " ]\n";
}

Eigen::MatrixXd DistortionOf(const LensCamera& camera) {
  return Eigen::Map<const Eigen::Matrix<double, 1, 5>>(camera.distortion.data());
}

// Returns whether the depth jumps or ends near a point, where stereo cameras measure little.
bool IsAtEdge(const DepthImage& depth, const MarkedPoint& point) {
  constexpr int kReach = 12;
  constexpr double kJump = 5e-3;
  const int u = static_cast<int>(std::lround(point.pixel.x()));
  const int v = static_cast<int>(std::lround(point.pixel.y()));
  for (int dv = -kReach; dv <= kReach; dv += kReach) {
    for (int du = -kReach; du <= kReach; du += kReach) {
      if (!depth.Contains(u + du, v + dv)) return true;
      if (std::abs(depth(u + du, v + dv) - point.depth) > kJump) return true;
    }
  }
  return false;
}

}  // namespace

LayoutWriter::LayoutWriter(std::string directory,
                           const SequenceWriterOptions& options,
                           int first_number)
    : directory_(std::move(directory)), options_(options), first_number_(first_number) {}

Status LayoutWriter::WriteFrame(const FrameToWrite& frame) {
  const int number = first_number_ + num_frames();
  poses_.push_back(frame.world_from_camera);
  Status status = WritePictures(number, frame);
  if (status.ok() && frame.truth != nullptr) status = AddTruth(*frame.truth);
  if (frame.truth != nullptr && frame.depth != nullptr) AddMarks(frame);
  return status;
}

MarkedPoint LayoutWriter::MarkOf(const FrameToWrite& frame, const Eigen::Vector3d& in_world) const {
  const PinholeCamera& camera = options_.camera.camera;
  const CameraPose& pose = frame.world_from_camera;
  const Eigen::Vector3d in_camera = pose.rotation.conjugate() * (in_world - pose.translation);
  MarkedPoint mark;
  mark.depth = in_camera.z();
  if (!(mark.depth > 0.0)) return mark;
  mark.pixel = camera.Project(in_camera);
  const int u = static_cast<int>(std::lround(mark.pixel.x()));
  const int v = static_cast<int>(std::lround(mark.pixel.y()));
  // What the camera sees there must be the vertex itself.
  constexpr double kTolerance = 2e-3;
  constexpr int kMargin = 12;
  mark.visible = u >= kMargin && v >= kMargin && u < camera.width - kMargin &&
                 v < camera.height - kMargin &&
                 std::abs((*frame.depth)(u, v) - mark.depth) < kTolerance;
  return mark;
}

void LayoutWriter::AddMarks(const FrameToWrite& frame) {
  if (marks_.empty()) {
    constexpr std::size_t kMost = 12;
    // Half of the distance at which they would fill the picture.
    const double distance = 0.12 * options_.camera.camera.width;
    std::vector<Eigen::Vector2d> pixels;
    for (std::size_t i = 0; i < frame.truth->size() && marked_.size() < kMost; ++i) {
      const MarkedPoint mark = MarkOf(frame, (*frame.truth)[i]);
      const bool is_alone = std::all_of(pixels.begin(), pixels.end(), [&](const auto& pixel) {
        return (pixel - mark.pixel).norm() > distance;
      });
      if (!mark.visible || !is_alone || IsAtEdge(*frame.depth, mark)) continue;
      marked_.push_back(i);
      pixels.push_back(mark.pixel);
    }
  }
  marks_.emplace_back();
  for (const std::size_t vertex : marked_) {
    marks_.back().push_back(MarkOf(frame, (*frame.truth)[vertex]));
  }
}

Status LayoutWriter::AddTruth(const std::vector<Eigen::Vector3d>& points) {
  if (truth_ == nullptr) {
    StatusOr<std::unique_ptr<SceneTruthWriter>> writer =
        SceneTruthWriter::Create(directory_, options_.truth_triangles);
    if (!writer.ok()) return writer.status();
    truth_ = *std::move(writer);
    // The truth begins with frame 0, which some layouts do not have: it repeats the first one.
    for (int i = 0; i < first_number_; ++i) {
      Status status = truth_->Add(points);
      if (!status.ok()) return status;
    }
  }
  return truth_->Add(points);
}

Status LayoutWriter::Close() {
  for (OpenVideo& video : videos_) {
    Status status = video.encoder->Close();
    if (!status.ok()) return status;
  }
  Status status = WriteCalibration();
  if (status.ok() && truth_ != nullptr) status = truth_->Close();
  return status;
}

std::vector<FramePose> LayoutWriter::FramePoses() const {
  std::vector<FramePose> rows;
  for (const CameraPose& pose : poses_) {
    rows.push_back({first_number_ + static_cast<int>(rows.size()), pose});
  }
  return rows;
}

std::string LayoutWriter::Path(const std::string& name) const {
  const fs::path path = fs::path(directory_) / name;
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  return path.string();
}

Status LayoutWriter::WriteText(const std::string& name, const std::string& text) const {
  return WriteFileAtomically(Path(name), text);
}

Status LayoutWriter::AddToVideo(const std::string& name, const ColorImage& picture) {
  auto video = std::find_if(
      videos_.begin(), videos_.end(), [&name](const OpenVideo& open) { return open.name == name; });
  if (video == videos_.end()) {
    StatusOr<std::unique_ptr<VideoEncoder>> encoder =
        CreateVideo(Path(name), picture.width(), picture.height(), kFramesPerSecond);
    if (!encoder.ok()) return encoder.status();
    videos_.push_back({name, *std::move(encoder)});
    video = videos_.end() - 1;
  }
  return video->encoder->Add(picture);
}

ColorImage LayoutWriter::Stacked(const ColorImage& left, const ColorImage& right) {
  ColorImage both(left.width(), left.height() + right.height());
  std::copy(left.pixels().begin(), left.pixels().end(), both.pixels().begin());
  std::copy(right.pixels().rbegin(), right.pixels().rend(), both.pixels().rbegin());
  return both;
}

ColorImage LayoutWriter::MaskPicture(const MaskImage& mask, bool white_is_left_out) {
  ColorImage picture(mask.width(), mask.height());
  std::transform(mask.pixels().begin(),
                 mask.pixels().end(),
                 picture.pixels().begin(),
                 [white_is_left_out](std::uint8_t value) {
                   const std::uint8_t grey = (value != 0) != white_is_left_out ? 255 : 0;
                   return std::array<std::uint8_t, 3>{grey, grey, grey};
                 });
  return picture;
}

Status CheckLayoutFolder(const std::string& directory, const SequenceWriterOptions& options) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (!IsFolder(directory)) {
    return Status::Error(directory + ": can't be made a folder" +
                         (error ? ": " + error.message() : std::string()));
  }
  if (options.overwrite || IsEmptyFolder(directory)) return Status::Ok();
  return Status::Error(directory +
                       ": is not empty, expected an empty folder or leave to overwrite it");
}

std::string NumberedName(const std::string& prefix, int number, const std::string& suffix) {
  char digits[16];
  std::snprintf(digits, sizeof(digits), "%06d", number);
  return prefix + digits + suffix;
}

std::string JsonMatrix(const Eigen::MatrixXd& matrix) {
  std::string text = "[";
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    text += row == 0 ? "[" : ", [";
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      if (column > 0) text += ", ";
      AppendNumbers({matrix(row, column)}, &text);
    }
    text += "]";
  }
  return text + "]";
}

Eigen::Matrix3d CameraMatrixOf(const PinholeCamera& camera) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 0) = camera.fx;
  matrix(1, 1) = camera.fy;
  matrix(0, 2) = camera.cx;
  matrix(1, 2) = camera.cy;
  return matrix;
}

std::string OpenCvCalibrationText(const StereoRig& rig) {
  return "%YAML:1.0\n---\n" + OpenCvMatrix("M1", CameraMatrixOf(rig.left.pinhole)) +
         OpenCvMatrix("D1", DistortionOf(rig.left)) +
         OpenCvMatrix("M2", CameraMatrixOf(rig.right.pinhole)) +
         OpenCvMatrix("D2", DistortionOf(rig.right)) +
         OpenCvMatrix("R", rig.right_from_left.rotation.toRotationMatrix()) +
         OpenCvMatrix("T", rig.right_from_left.translation * kMillimetresPerMetre);
}

}  // namespace ceres_ed
