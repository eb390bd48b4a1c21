#include "ceres_ed/io/sequence/native_writer.h"

#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layouts/stereo_file.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPictureFolders[] = {"color", "depth", "left", "right", "mask"};
constexpr const char* kFiles[] = {
    "camera.txt", "stereo.txt", "poses.txt", kTruthMeshName, kTruthVerticesName};

std::string PictureName(int frame) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.png", frame);
  return name;
}

// Returns whether the name is that of a numbered image, such as 000123.png or 7.jpg.
bool IsNumberedPicture(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".png" && extension != ".jpg" && extension != ".jpeg") return false;
  const std::string stem = path.stem().string();
  return !stem.empty() && stem.find_first_not_of("0123456789") == std::string::npos;
}

// Returns all files in `directory` that belong to a sequence.
std::vector<fs::path> SequenceFiles(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const char* name : kFiles) {
    if (fs::exists(directory / name, ignored)) files.push_back(directory / name);
  }
  for (const char* folder : kPictureFolders) {
    for (fs::directory_iterator it(directory / folder, ignored), end; it != end;
         it.increment(ignored)) {
      if (IsNumberedPicture(it->path())) files.push_back(it->path());
    }
  }
  return files;
}

Status MakeFolder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (fs::is_directory(path)) return Status::Ok();
  const std::string reason = error ? error.message() : "it is a file, expected a folder";
  return Status::Error(path.string() + ": can't be made a folder: " + reason);
}

Status CheckFolder(const fs::path& directory, bool overwrite) {
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error)) {
    return Status::Error(directory.string() + ": is a file, expected a folder or a new name");
  }
  const std::vector<fs::path> old = SequenceFiles(directory);
  if (!old.empty() && !overwrite) {
    return Status::Error(directory.string() + ": holds a sequence already (" +
                         old.front().lexically_relative(directory).string() +
                         "), expected an empty folder or leave to overwrite it");
  }
  for (const fs::path& path : old) {
    if (!fs::remove(path, error)) {
      return Status::Error(path.string() + ": can't be removed: " + error.message());
    }
  }
  return Status::Ok();
}

ColorImage MaskPicture(const MaskImage& mask) {
  ColorImage picture(mask.width(), mask.height());
  std::transform(
      mask.pixels().begin(), mask.pixels().end(), picture.pixels().begin(), [](std::uint8_t value) {
        const std::uint8_t grey = value != 0 ? 255 : 0;
        return std::array<std::uint8_t, 3>{grey, grey, grey};
      });
  return picture;
}

}  // namespace

bool HoldsNativeSequence(const std::string& directory) { return !SequenceFiles(directory).empty(); }

NativeSequenceWriter::NativeSequenceWriter(std::string directory,
                                           const SequenceWriterOptions& options)
    : directory_(std::move(directory)), options_(options) {}

StatusOr<std::unique_ptr<NativeSequenceWriter>> NativeSequenceWriter::Create(
    const std::string& directory, const SequenceWriterOptions& options) {
  const fs::path root(directory);
  if (Status status = CheckFolder(root, options.overwrite); !status.ok()) return status;
  Status status = MakeFolder(root / (options.rig.has_value() ? "left" : "depth"));
  if (!status.ok()) return status;
  status = options.rig.has_value()
               ? WriteStereoFile((root / "stereo.txt").string(), *options.rig)
               : WriteCameraFile((root / "camera.txt").string(), options.camera);
  if (!status.ok()) return status;
  std::unique_ptr<NativeSequenceWriter> writer(new NativeSequenceWriter(directory, options));
  return StatusOr<std::unique_ptr<NativeSequenceWriter>>(std::move(writer));
}

StatusOr<std::unique_ptr<SequenceWriter>> CreateNativeWriter(const std::string& directory,
                                                             const SequenceWriterOptions& options) {
  StatusOr<std::unique_ptr<NativeSequenceWriter>> writer =
      NativeSequenceWriter::Create(directory, options);
  if (!writer.ok()) return writer.status();
  return std::unique_ptr<SequenceWriter>(*std::move(writer));
}

Status NativeSequenceWriter::WriteFrame(const FrameToWrite& frame) {
  const bool is_stereo = options_.rig.has_value();
  CHECK(is_stereo || frame.depth != nullptr);
  CHECK(!is_stereo || (frame.color != nullptr && frame.right != nullptr));
  const auto check_size = [this](const auto& image) {
    CHECK_EQ(image.width(), options_.camera.camera.width);
    CHECK_EQ(image.height(), options_.camera.camera.height);
  };
  const fs::path root(directory_);
  const int number = frame.number >= 0 ? frame.number : last_number_ + 1;
  CHECK_GT(number, last_number_);
  const std::string name = PictureName(number);
  const auto write_picture = [&](const char* folder, const ColorImage& picture) {
    check_size(picture);
    if (Status status = MakeFolder(root / folder); !status.ok()) return status;
    return WriteColorImage((root / folder / name).string(), picture);
  };
  if (frame.color != nullptr && !frame.color->empty()) {
    if (Status status = write_picture(is_stereo ? "left" : "color", *frame.color); !status.ok())
      return status;
  }
  if (frame.mask != nullptr && !frame.mask->empty()) {
    Status status = write_picture("mask", MaskPicture(*frame.mask));
    if (!status.ok()) return status;
  }
  // Depth or the right picture is written last, since without it a frame does not count as one.
  Status status = Status::Ok();
  if (is_stereo) {
    status = write_picture("right", *frame.right);
  } else {
    check_size(*frame.depth);
    status = WriteDepthImage(
        (root / "depth" / name).string(), *frame.depth, options_.camera.depth_units_per_metre);
  }
  if (!status.ok()) return status;
  if (frame.truth != nullptr) {
    status = WriteTruth(*frame.truth);
    if (!status.ok()) return status;
  } else {
    CHECK(truth_ == nullptr) << "frame " << num_frames() << " has no truth, those before it had";
  }
  if (frame.has_pose) poses_.push_back({number, frame.world_from_camera});
  last_number_ = number;
  ++num_frames_;
  return Status::Ok();
}

Status NativeSequenceWriter::WriteTruth(const std::vector<Eigen::Vector3d>& points) {
  if (truth_ == nullptr) {
    CHECK_EQ(num_frames(), 0) << "frames before this one had no truth";
    StatusOr<std::unique_ptr<SceneTruthWriter>> writer =
        SceneTruthWriter::Create(directory_, options_.truth_triangles);
    if (!writer.ok()) return writer.status();
    truth_ = *std::move(writer);
  }
  return truth_->Add(points);
}

Status NativeSequenceWriter::Close() {
  if (truth_ != nullptr) {
    if (Status status = truth_->Close(); !status.ok()) return status;
  }
  if (poses_.empty() && num_frames_ > 0) return Status::Ok();
  return WritePosesFile((fs::path(directory_) / "poses.txt").string(), poses_);
}

}  // namespace ceres_ed
