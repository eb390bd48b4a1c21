// SurgT: a stereo video, calibration.yaml, and info.yaml.
#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>
#include <ceres_ed/io/text.h>

namespace ceres_ed {
namespace {

constexpr char kCalibrationName[] = "calibration.yaml";

// Returns a field of info.yaml that is a text, or `fallback`.
std::string TextField(const nlohmann::json& info, const char* name, const std::string& fallback) {
  const auto field = info.is_object() ? info.find(name) : info.end();
  return info.is_object() && field != info.end() && field->is_string() ? field->get<std::string>()
                                                                       : fallback;
}

StatusOr<Stacking> StackingOf(const std::string& path, const std::string& name) {
  if (name == "vertical") return Stacking::kVertical;
  if (name == "horizontal") return Stacking::kHorizontal;
  return Status::Error(path + ": video_stack is " + Quoted(name) +
                       ", expected vertical or horizontal");
}

}  // namespace

bool IsSurgT(const std::string& directory) {
  return IsFile(JoinPath(directory, kCalibrationName)) && IsFile(JoinPath(directory, "info.yaml"));
}

StatusOr<SequenceListing> ListSurgT(const std::string& directory) {
  const std::string calibration_path = JoinPath(directory, kCalibrationName);
  if (!IsFile(calibration_path)) {
    return MissingCalibration(calibration_path, "M1, D1, M2, D2, R and T, as OpenCV writes them");
  }
  StatusOr<StereoCalibration> calibration = ReadOpenCvCalibration(calibration_path);
  if (!calibration.ok()) return calibration.status();
  const std::string info_path = JoinPath(directory, "info.yaml");
  const StatusOr<nlohmann::json> info = ReadYamlFile(info_path);
  if (!info.ok()) return info.status();
  const std::string named = TextField(*info, "name_video", "video.mp4");
  const std::string video = FirstFile(directory, {named, "video.mp4", "video.avi"});
  if (video.empty()) {
    return Status::Error(JoinPath(directory, named) + ": not there, expected the video that " +
                         info_path + " names");
  }
  const StatusOr<Stacking> stacking =
      StackingOf(info_path, TextField(*info, "video_stack", "vertical"));
  if (!stacking.ok()) return stacking.status();
  SequenceListing listing;
  listing.warnings.push_back(video + ": " + StackingText(*stacking) + " (by info.yaml)");
  Status status = AddStackedVideo(video, *stacking, 0, &listing);
  if (!status.ok()) return status;
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing.entries.front().color);
  if (!size.ok()) return size.status();
  status = FitCalibration(calibration_path, size->first, size->second, &*calibration);
  if (!status.ok()) return status;
  SetCalibration(*calibration, &listing);
  return listing;
}

}  // namespace ceres_ed
