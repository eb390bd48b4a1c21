#include "ceres_ed/pipeline/slam/slam_output.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/graph_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/results/covariance_files.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/results/map_ply.h>
#include <ceres_ed/io/results/tracks_csv.h>
#include <ceres_ed/io/results/trajectory_txt.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/pipeline/slam/map_export.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

constexpr char kFrames[] = "frames.csv";
constexpr char kTrajectory[] = "trajectory.txt";
constexpr char kTracks[] = "tracks.csv";
constexpr char kMasks[] = "masks";
constexpr char kLive[] = "live";
constexpr char kMap[] = "map.ply";
constexpr char kGraph[] = "graph.ply";
constexpr char kCameraCovariance[] = "camera_covariance.csv";
constexpr char kMapCovariance[] = "map_covariance.ply";

// Returns the name without the ending of a temporary file: a killed run may have left a file
// NAME.tmp.HOST.PID.N.
std::string WithoutTemporaryEnd(const std::string& name) {
  return name.substr(0, std::min(name.find(".tmp."), name.size()));
}

// The files of a result that grow frame by frame, and those that are replaced.
constexpr const char* kGrowing[] = {kFrames, kTrajectory, kTracks, kCameraCovariance};
constexpr const char* kReplaced[] = {kMap, kMapCovariance, kGraph, kReportName, kCheckpointName};

template <std::size_t size>
bool Has(const char* const (&names)[size], const std::string& name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool IsResultName(const std::string& name) { return Has(kGrowing, name) || Has(kReplaced, name); }

// Returns whether this is the name of a mask, or what a killed run has left of one.
bool IsMaskName(const std::string& name) {
  const std::string end = WithoutTemporaryEnd(name);
  return end.size() >= 10 && end.compare(end.size() - 4, 4, ".png") == 0 &&
         end.find_first_not_of("0123456789") == end.size() - 4;
}

// Removes the files in a folder for whose names `goes` returns true.
template <typename Predicate>
void RemoveFiles(const std::string& directory, Predicate goes) {
  std::error_code error;
  std::vector<fs::path> gone;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, error)) {
    std::error_code no_file;
    if (goes(entry.path().filename().string()) && entry.is_regular_file(no_file)) {
      gone.push_back(entry.path());
    }
  }
  for (const fs::path& path : gone) fs::remove(path, error);
}

// Removes the temporary files of a killed run and, if `results_too`, the results of an earlier one.
void RemoveLeftOvers(const std::string& directory, bool results_too) {
  const auto goes = [results_too](const std::string& name) {
    return results_too || name.find(".tmp.") != std::string::npos;
  };
  RemoveFiles(directory, [&](const std::string& name) {
    return goes(name) && IsResultName(WithoutTemporaryEnd(name));
  });
  RemoveFiles(directory + "/" + kMasks,
              [&](const std::string& name) { return goes(name) && IsMaskName(name); });
  RemoveFiles(directory + "/" + kLive, [&](const std::string& name) {
    return goes(name) && IsLiveCloudName(WithoutTemporaryEnd(name));
  });
}

// Removes the symbolic links that have the names of results: a run must not write into files and
// folders that lie elsewhere. A run that goes on in its own files refuses links to them instead
// (`results_too` is false). Links to devices and pipes stay.
Status RemoveLinks(const std::string& directory, bool results_too) {
  std::vector<std::string> names = {kMasks, kLive};
  names.insert(names.end(), std::begin(kGrowing), std::end(kGrowing));
  names.insert(names.end(), std::begin(kReplaced), std::end(kReplaced));
  for (const std::string& name : names) {
    const std::string path = directory + "/" + name;
    std::error_code error;
    if (!fs::is_symlink(path, error) || fs::is_other(path, error)) continue;
    if (!results_too && Has(kGrowing, name)) {
      return Status::Error(path + ": is a symbolic link, expected the file that the run has begun");
    }
    if (!fs::remove(path, error)) return Status::Error(path + ": cannot write: " + error.message());
  }
  return Status::Ok();
}

Status MakeFolders(const std::string& directory, bool results_too) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (!error) {
    if (Status status = RemoveLinks(directory, results_too); !status.ok()) return status;
    fs::create_directories(directory + "/" + kLive, error);
  }
  if (error) {
    return Status::Error(directory + ": cannot be created as a folder: " + error.message());
  }
  // Only an attempt shows whether permissions and mounts allow a file.
  const auto probe = AtomicFile::Create(directory + "/" + kFrames);
  return probe.ok() ? Status::Ok() : probe.status();
}

// The sizes in bytes of the files that grow; -1 for a file that does not exist yet.
struct FileSizes {
  double frames = -1.0;
  double trajectory = -1.0;
  double tracks = -1.0;
  double covariance = -1.0;

  void Exchange(CheckpointArchive* archive) {
    archive->Enter("file_sizes");
    archive->Value("frames", &frames);
    archive->Value("trajectory", &trajectory);
    archive->Value("tracks", &tracks);
    archive->Value("covariance", &covariance);
    archive->Leave();
  }
};

Status ReopenFile(const std::string& path, double size, AppendFile* file) {
  if (size < 0.0) return Status::Ok();
  StatusOr<AppendFile> reopened = AppendFile::Reopen(path, static_cast<std::int64_t>(size));
  if (!reopened.ok()) return reopened.status();
  *file = *std::move(reopened);
  return Status::Ok();
}

}  // namespace

bool HoldsResult(const std::string& directory) {
  const StatusOr<std::string> text = ReadWholeFile(directory + "/" + kReportName);
  if (!text.ok()) return false;
  const auto report = ParseJson<nlohmann::json>(kReportName, *text);
  if (!report.ok() || !report->is_object()) return true;
  const auto status = report->find("status");
  return status == report->end() || (*status != "running" && *status != "failed");
}

StatusOr<std::unique_ptr<SlamOutput>> SlamOutput::Create(const std::string& directory,
                                                         const PinholeCamera& camera) {
  Status status = MakeFolders(directory, /*results_too=*/true);
  if (!status.ok()) return status;
  RemoveLeftOvers(directory, /*results_too=*/true);
  std::unique_ptr<SlamOutput> output(new SlamOutput(directory, camera));
  StatusOr<AppendFile> frames = AppendFile::Create(output->Path(kFrames));
  if (!frames.ok()) return frames.status();
  output->frames_ = *std::move(frames);
  StatusOr<AppendFile> trajectory = AppendFile::Create(output->Path(kTrajectory));
  if (!trajectory.ok()) return trajectory.status();
  output->trajectory_ = *std::move(trajectory);
  status = output->frames_.Append(FramesHeader());
  if (status.ok()) status = output->trajectory_.Append(TrajectoryHeader());
  if (!status.ok()) return status;
  return StatusOr<std::unique_ptr<SlamOutput>>(std::move(output));
}

StatusOr<std::unique_ptr<SlamOutput>> SlamOutput::Reopen(const std::string& directory,
                                                         const PinholeCamera& camera,
                                                         CheckpointArchive* archive) {
  Status status = MakeFolders(directory, /*results_too=*/false);
  if (!status.ok()) return status;
  RemoveLeftOvers(directory, /*results_too=*/false);
  FileSizes sizes;
  sizes.Exchange(archive);
  if (!archive->status().ok()) return archive->status();
  std::unique_ptr<SlamOutput> output(new SlamOutput(directory, camera));
  status = ReopenFile(output->Path(kFrames), sizes.frames, &output->frames_);
  if (status.ok()) {
    status = ReopenFile(output->Path(kTrajectory), sizes.trajectory, &output->trajectory_);
  }
  if (status.ok()) status = ReopenFile(output->Path(kTracks), sizes.tracks, &output->tracks_);
  if (status.ok()) {
    status = ReopenFile(output->Path(kCameraCovariance), sizes.covariance, &output->covariance_);
  }
  if (!status.ok()) return status;
  return StatusOr<std::unique_ptr<SlamOutput>>(std::move(output));
}

void SlamOutput::Save(CheckpointArchive* archive) const {
  const auto size = [](const AppendFile& file) {
    return file.is_open() ? static_cast<double>(file.size()) : -1.0;
  };
  FileSizes sizes;
  sizes.frames = size(frames_);
  sizes.trajectory = size(trajectory_);
  sizes.tracks = size(tracks_);
  sizes.covariance = size(covariance_);
  sizes.Exchange(archive);
}

Status SlamOutput::WriteFrame(const FrameRecord& record,
                              const DeformableSlam& slam,
                              const FrameOutput& options) {
  if (!HasPose(record)) return Status::Ok();
  if (options.live) {
    const std::string path = Path(std::string(kLive) + "/" + LiveCloudName(record.number));
    Status status = WriteLiveCloud(path, ExportLivePoints(slam));
    if (!status.ok()) return status;
  }
  if (options.mask != nullptr) {
    Status status = WriteMask(record.number, *options.mask);
    if (!status.ok()) return status;
  }
  if (options.tracked != nullptr) {
    Status status = WriteTracks(record.number, slam, *options.tracked);
    if (!status.ok()) return status;
  }
  if (options.camera_covariance != nullptr) {
    Status status = WriteCovariance(record.number, *options.camera_covariance);
    if (!status.ok()) return status;
  }
  return trajectory_.Append(TrajectoryRow(options.time_s, ExportCameraPose(slam)));
}

Status SlamOutput::WriteRecord(const FrameRecord& record) {
  return frames_.Append(FramesRow(record));
}

Status SlamOutput::WriteMask(int frame, const MaskImage& mask) const {
  std::error_code error;
  fs::create_directory(Path(kMasks), error);
  char name[32];
  std::snprintf(name, sizeof(name), "/%06d.png", frame);
  return WriteMaskImage(Path(kMasks) + name, mask);
}

Status SlamOutput::WriteTracks(int frame,
                               const DeformableSlam& slam,
                               const TrackedPoints& tracked) {
  std::string rows;
  if (!tracks_.is_open()) {
    StatusOr<AppendFile> file = AppendFile::Create(Path(kTracks));
    if (!file.ok()) return file.status();
    tracks_ = *std::move(file);
    rows = TracksHeader();
  }
  const std::vector<TrackedPlace> places = tracked.Locate(slam, camera_);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int id = tracked.id(static_cast<int>(i));
    rows += TracksRow(frame, id, places[i].in_camera, places[i].visible);
  }
  return tracks_.Append(rows);
}

Status SlamOutput::WriteCovariance(int frame, const Eigen::Matrix<double, 6, 6>& camera) {
  std::string rows;
  if (!covariance_.is_open()) {
    StatusOr<AppendFile> file = AppendFile::Create(Path(kCameraCovariance));
    if (!file.ok()) return file.status();
    covariance_ = *std::move(file);
    rows = CameraCovarianceHeader();
  }
  return covariance_.Append(rows + CameraCovarianceRow(frame, camera));
}

Status SlamOutput::WriteMap(const DeformableSlam& slam, bool with_covariances) const {
  Status status = WriteMapCloud(Path(kMap), ExportMap(slam));
  if (status.ok() && with_covariances) {
    status = WriteMapCovariances(Path(kMapCovariance), ExportMapCovariances(slam));
  }
  if (!status.ok()) return status;
  const Warp warp = ExportWarp(slam);
  GraphWriteOptions options;
  options.with_colors = true;
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    options.is_point_relevant.push_back(slam.HasData(j));
  }
  return WriteGraph(Path(kGraph), warp.graph, warp.state, options);
}

}  // namespace ceres_ed
