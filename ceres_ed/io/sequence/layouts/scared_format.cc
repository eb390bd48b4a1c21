// SCARED: a keyframe with its depth, and a video that goes on from there.
#include <ceres_ed/io/calibration/calibration_fields.h>
#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

namespace ceres_ed {
namespace {

constexpr double kMillimetresPerMetre = 1000.0;

std::string CalibrationPath(const std::string& directory) {
  return FirstFile(directory, {"endoscope_calibration.yaml", "data/endoscope_calibration.yaml"});
}

// Adds the poses of data/frame_data/frame_dataNNNNNN.json: camera-pose, millimetres.
Status AddPoses(const std::string& directory, SequenceListing* listing) {
  const std::string folder = JoinPath(directory, "data/frame_data");
  const std::string archive = JoinPath(directory, "data/frame_data.tar.gz");
  if (!IsFolder(folder)) {
    if (IsFile(archive)) {
      listing->warnings.push_back(archive + ": holds the poses; to use them, make the folder " +
                                  folder + " and unpack the file there: tar -xzf " + archive +
                                  " -C " + folder);
    }
    return Status::Ok();
  }
  const std::map<int, std::string> files = FilesByNumber(folder, ".json");
  for (SequenceEntry& entry : listing->entries) {
    const auto file = files.find(entry.number);
    if (file == files.end()) continue;
    const StatusOr<nlohmann::json> frame = ReadJsonFile(file->second);
    if (!frame.ok()) return frame.status();
    const StatusOr<Eigen::MatrixXd> matrix = ReadMatrix(file->second, *frame, "camera-pose", 4, 4);
    if (!matrix.ok()) return matrix.status();
    const StatusOr<CameraPose> pose =
        PoseFromMatrix(file->second + ": camera-pose: ", *matrix, kMillimetresPerMetre);
    if (!pose.ok()) return pose.status();
    entry.world_from_camera = *pose;
  }
  listing->has_poses = !files.empty();
  return Status::Ok();
}

// The one frame of a keyframe without a video.
Status ListKeyframe(const std::string& directory, SequenceListing* listing) {
  SequenceEntry entry;
  entry.color.path = JoinPath(directory, "Left_Image.png");
  entry.right.path = JoinPath(directory, "Right_Image.png");
  if (!IsFile(entry.color.path)) {
    return Status::Error(entry.color.path + ": not there, expected it or data/rgb.mp4");
  }
  if (!IsFile(entry.right.path)) entry.right = {};
  const std::string depth = JoinPath(directory, "left_depth_map.tiff");
  if (IsFile(depth)) entry.depth.path = depth;
  listing->entries.push_back(entry);
  listing->has_color = true;
  return Status::Ok();
}

}  // namespace

bool IsScared(const std::string& directory) {
  return !CalibrationPath(directory).empty() && (IsFile(JoinPath(directory, "Left_Image.png")) ||
                                                 IsFile(JoinPath(directory, "data/rgb.mp4")));
}

StatusOr<SequenceListing> ListScared(const std::string& directory) {
  const std::string path = CalibrationPath(directory);
  if (path.empty()) {
    return MissingCalibration(JoinPath(directory, "endoscope_calibration.yaml"),
                              "M1, D1, M2, D2, R and T, as OpenCV writes them");
  }
  StatusOr<StereoCalibration> calibration = ReadOpenCvCalibration(path);
  if (!calibration.ok()) return calibration.status();
  SequenceListing listing;
  const std::string video = JoinPath(directory, "data/rgb.mp4");
  Status status = IsFile(video) ? AddStackedVideo(video, Stacking::kVertical, 0, &listing)
                                : ListKeyframe(directory, &listing);
  if (!status.ok()) return status;
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing.entries.front().color);
  if (!size.ok()) return size.status();
  status = FitCalibration(path, size->first, size->second, &*calibration);
  if (!status.ok()) return status;
  SetCalibration(*calibration, &listing);
  if (listing.entries.front().right.empty()) listing.rig.reset();
  listing.camera.depth_units_per_metre = kMillimetresPerMetre;
  status = AddPoses(directory, &listing);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
