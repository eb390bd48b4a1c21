#include "apps/slam_output.h"

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/graph_io.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <system_error>
#include <utility>
#include <vector>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

constexpr char kFrames[] = "frames.csv";
constexpr char kTrajectory[] = "trajectory.txt";
constexpr char kTracks[] = "tracks.csv";
constexpr char kMap[] = "map.ply";
constexpr char kGraph[] = "graph.ply";

std::string LiveName(int frame) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.ply", frame);
  return name;
}

bool IsLiveName(const std::string& name) {
  const std::size_t digits = name.size() - std::min<std::size_t>(4, name.size());
  return digits >= 6 && name.substr(digits) == ".ply" &&
         std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(digits), [](char c) {
           return std::isdigit(static_cast<unsigned char>(c)) != 0;
         });
}

// A killed run may have left a file under its temporary name, NAME.tmp.PID.N.
std::string WithoutTemporaryEnd(const std::string& name) {
  return name.substr(0, std::min(name.find(".tmp."), name.size()));
}

bool IsResultName(const std::string& name) {
  for (const char* known :
       {kFrames, kTrajectory, kTracks, kMap, kGraph, "report.json", "checkpoint.cbor"}) {
    if (name == known) return true;
  }
  return false;
}

// Removes the files of a folder whose name `goes`.
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

void RemoveLeftOvers(const std::string& directory, bool results_too) {
  const auto goes = [results_too](const std::string& name) {
    return results_too || name.find(".tmp.") != std::string::npos;
  };
  RemoveFiles(directory, [&](const std::string& name) {
    return goes(name) && IsResultName(WithoutTemporaryEnd(name));
  });
  RemoveFiles(directory + "/live", [&](const std::string& name) {
    return goes(name) && IsLiveName(WithoutTemporaryEnd(name));
  });
}

Status MakeFolders(const std::string& directory) {
  std::error_code error;
  fs::create_directories(directory + "/live", error);
  if (error) {
    return Status::Error(directory + ": cannot be made a folder: " + error.message());
  }
  // What permissions and mounts allow is for the system to say.
  const auto probe = AtomicFile::Create(directory + "/" + kFrames);
  return probe.ok() ? Status::Ok() : probe.status();
}

void AppendRow(std::initializer_list<double> numbers, std::string* text) {
  std::string row;
  AppendNumbers(numbers, &row);
  std::replace(row.begin(), row.end(), ' ', ',');
  *text += row;
}

// Bytes of frames.csv, trajectory.txt and tracks.csv; -1 for one that isn't there yet.
struct FileSizes {
  double frames = -1.0;
  double trajectory = -1.0;
  double tracks = -1.0;

  void Exchange(CheckpointArchive* archive) {
    archive->Enter("file_sizes");
    archive->Value("frames", &frames);
    archive->Value("trajectory", &trajectory);
    archive->Value("tracks", &tracks);
    archive->Leave();
  }
};

Status ReopenFile(const std::string& path, double size, AppendFile* file) {
  if (size < 0.0) return Status::Ok();
  StatusOr<AppendFile> reopened = AppendFile::Reopen(path, static_cast<std::int64_t>(size));
  if (reopened.ok()) *file = *std::move(reopened);
  return reopened.status();
}

// The nodes and their deformation in metres.
void InMetres(const DeformableSlam& slam, DeformationGraph* graph, DeformationState* state) {
  const DeformationGraph& nodes = slam.map().graph();
  for (const Eigen::Vector3d& position : nodes.positions()) {
    graph->AddNode(slam.unit() * position);
  }
  for (const GraphEdge& edge : nodes.edges()) graph->AddEdge(edge);
  *state = slam.map().state();
  for (int j = 0; j < state->num_nodes(); ++j) {
    MutableNodeTranslation(state->node(j)) *= slam.unit();
  }
}

}  // namespace

StatusOr<std::unique_ptr<SlamOutput>> SlamOutput::Create(const std::string& directory,
                                                         const PinholeCamera& camera) {
  Status status = MakeFolders(directory);
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
  if (status.ok()) {
    status = output->trajectory_.Append(
        "# timestamp tx ty tz qx qy qz qw, camera to map, seconds and metres\n");
  }
  if (!status.ok()) return status;
  return StatusOr<std::unique_ptr<SlamOutput>>(std::move(output));
}

StatusOr<std::unique_ptr<SlamOutput>> SlamOutput::Reopen(const std::string& directory,
                                                         const PinholeCamera& camera,
                                                         CheckpointArchive* archive) {
  Status status = MakeFolders(directory);
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
  sizes.Exchange(archive);
}

Status SlamOutput::WriteFrame(const FrameRecord& record,
                              const DeformableSlam& slam,
                              const FrameOutput& options) {
  if (!HasPose(record.status)) return Status::Ok();
  if (options.live) {
    Status status = WriteLive(record.number, slam);
    if (!status.ok()) return status;
  }
  if (options.tracked != nullptr) {
    Status status = WriteTracks(record.number, slam, *options.tracked);
    if (!status.ok()) return status;
  }
  return WritePose(options.time_s, slam);
}

Status SlamOutput::WriteRecord(const FrameRecord& record) {
  return frames_.Append(FramesRow(record));
}

Status SlamOutput::WriteLive(int frame, const DeformableSlam& slam) const {
  const DeformableMap& map = slam.map();
  std::vector<LivePoint> points;
  points.reserve(static_cast<std::size_t>(map.num_points()));
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    if (!map.alive(slot)) continue;
    const MapPoint point = map.point(slot);
    const PointBinding binding = map.binding(slot);
    const Eigen::Vector3d in_camera =
        slam.camera_from_map() * WarpPoint(map.graph(), map.state(), binding, point.position);
    LivePoint live;
    live.position = (slam.unit() * in_camera).cast<float>();
    live.id = point.id;
    live.birth_frame = point.birth_frame;
    live.birth_position = (slam.unit() * point.birth_position).cast<float>();
    points.push_back(live);
  }
  return WriteLiveCloud(Path("live/" + LiveName(frame)), points);
}

Status SlamOutput::WritePose(double time_s, const DeformableSlam& slam) {
  const CameraPose& camera_from_map = slam.camera_from_map();
  const Eigen::Quaterniond q = camera_from_map.rotation.conjugate();
  const Eigen::Vector3d t = q * (-slam.unit() * camera_from_map.translation);
  std::string row;
  AppendNumbers({time_s, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}, &row);
  return trajectory_.Append(row + "\n");
}

Status SlamOutput::WriteTracks(int frame,
                               const DeformableSlam& slam,
                               const TrackedPoints& tracked) {
  std::string rows;
  if (!tracks_.is_open()) {
    StatusOr<AppendFile> file = AppendFile::Create(Path(kTracks));
    if (!file.ok()) return file.status();
    tracks_ = *std::move(file);
    rows = "frame,id,x,y,z,visible\n";
  }
  const std::vector<TrackedPlace> places = tracked.Locate(slam, camera_);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d& p = places[i].in_camera;
    rows += std::to_string(frame) + "," + std::to_string(tracked.id(static_cast<int>(i))) + ",";
    AppendRow({p.x(), p.y(), p.z()}, &rows);
    rows += places[i].visible ? ",1\n" : ",0\n";
  }
  return tracks_.Append(rows);
}

Status SlamOutput::WriteMap(const DeformableSlam& slam) const {
  const DeformableMap& map = slam.map();
  PointCloud cloud;
  CloudWriteOptions options;
  PlyProperty id = MakePlyScalar("id", PlyType::kInt32);
  PlyProperty birth_frame = MakePlyScalar("birth_frame", PlyType::kInt32);
  PlyProperty weight = MakePlyScalar("weight", PlyType::kFloat32);
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    if (!map.alive(slot)) continue;
    const MapPoint point = map.point(slot);
    const PointBinding binding = map.binding(slot);
    cloud.points.push_back(slam.unit() *
                           WarpPoint(map.graph(), map.state(), binding, point.position));
    cloud.normals.push_back(WarpNormal(map.state(), binding, point.normal));
    options.colors.push_back(point.color);
    id.values.push_back(point.id);
    birth_frame.values.push_back(point.birth_frame);
    weight.values.push_back(point.weight);
  }
  options.columns = {std::move(id), std::move(birth_frame), std::move(weight)};
  options.comments = {"map frame, metres"};
  Status status = WriteCloud(Path(kMap), cloud, options);
  if (!status.ok()) return status;

  DeformationGraph graph;
  DeformationState state;
  InMetres(slam, &graph, &state);
  GraphWriteOptions graph_options;
  graph_options.with_colors = true;
  for (int j = 0; j < graph.num_nodes(); ++j) {
    graph_options.is_point_relevant.push_back(slam.HasData(j));
  }
  return WriteGraph(Path(kGraph), graph, state, graph_options);
}

}  // namespace ceres_ed
