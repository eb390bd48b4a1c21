#include "fuzzed_readers.h"

#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/io/calibration/camera_matrix.h>
#include <ceres_ed/io/calibration/llff_poses.h>
#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/csv_table.h>
#include <ceres_ed/io/field/grid_reader.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/io/mesh/gltf_file.h>
#include <ceres_ed/io/mesh/obj_file.h>
#include <ceres_ed/io/mesh/off_file.h>
#include <ceres_ed/io/mesh/pcd_file.h>
#include <ceres_ed/io/mesh/ply_reader.h>
#include <ceres_ed/io/mesh/ply_writer.h>
#include <ceres_ed/io/mesh/stl_file.h>
#include <ceres_ed/io/mesh/vtk_file.h>
#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/point_list_io.h>
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/results/trajectory_txt.h>
#include <ceres_ed/io/sequence/layouts/matrix_file.h>
#include <ceres_ed/io/sequence/layouts/stereo_file.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/picture_tracks.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/util/status.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

// The number of vertices of the cloud to which lists of vertices belong.
constexpr int kNumVertices = 100;

// Returns what is wrong with the message of an error.
std::string FaultOfMessage(const std::string& message, const std::string& must_name) {
  const bool printable = std::all_of(message.begin(), message.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
  });
  if (!printable) return "the message has control characters: " + message;
  if (message.find(must_name) == std::string::npos) {
    return "the message does not name " + must_name + ": " + message;
  }
  return "";
}

template <typename T>
std::string FaultOf(const StatusOr<T>& result, const std::string& path) {
  return result.ok() ? "" : FaultOfMessage(result.status().message(), path);
}

// Also writes what was read, reads that, and writes it again: both files must have the same bytes.
template <typename Read, typename Write>
std::string FaultOfRoundTrip(const std::string& path,
                             const std::string& scratch,
                             const Read& read,
                             const Write& write) {
  const auto first = read(path);
  if (!first.ok()) return FaultOf(first, path);
  if (const Status status = write(scratch, *first); !status.ok()) {
    // Not everything that can be read can be written: formats may be narrower than the type.
    return FaultOfMessage(status.message(), scratch);
  }
  const StatusOr<std::string> once = ReadWholeFile(scratch);
  const auto second = read(scratch);
  if (!second.ok()) return "what was written can't be read: " + second.status().message();
  if (const Status status = write(scratch, *second); !status.ok()) return status.message();
  const StatusOr<std::string> twice = ReadWholeFile(scratch);
  if (!once.ok() || !twice.ok()) return "the file that was written is gone";
  return *once == *twice ? "" : "what was written and read again is not the same";
}

std::string CameraFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadCameraFile, WriteCameraFile);
}

std::string CheckpointFault(const std::string& path, const std::string&) {
  const StatusOr<std::string> bytes = ReadWholeFile(path);
  if (!bytes.ok()) return FaultOf(bytes, path);
  StatusOr<std::unique_ptr<CheckpointReader>> opened = CheckpointReader::Open(*bytes);
  if (!opened.ok()) return FaultOf(opened, "");
  // Whatever the values are called and however long they are: this asks for what a map has.
  CheckpointReader& reader = **opened;
  struct Row {
    std::array<double, 3> position;
    int node;
  };
  std::vector<Row> rows(3);
  std::vector<int> numbers;
  std::string text;
  reader.Enter("map");
  reader.Column(
      "position", &rows, [](Row & row) -> auto& { return row.position; });
  reader.Array("node", &numbers);
  reader.Text("name", &text);
  reader.Leave();
  return reader.status().ok() ? "" : FaultOfMessage(reader.status().message(), "");
}

std::string CloudFault(const std::string& path, const std::string&) {
  return FaultOf(LoadCloud(path), path);
}

std::string CsvFault(const std::string& path, const std::string&) {
  return FaultOf(ReadCsvRows(path), path);
}

std::string DepthFault(const std::string& path, const std::string&) {
  int saturated = 0;
  return FaultOf(ReadDepthImage(path, 1000.0, &saturated), path);
}

std::string EnergiesFault(const std::string& path, const std::string&) {
  const StatusOr<std::string> text = ReadWholeFile(path);
  if (!text.ok()) return FaultOf(text, path);
  return FaultOf(ParseEnergySpecs(*text), "");
}

std::string FixedFault(const std::string& path, const std::string&) {
  return FaultOf(ReadVertexList(path, kNumVertices), path);
}

// A mesh must also make a cloud, or an error, of whatever its faces name.
std::string MeshFault(const std::string& path,
                      const std::string& scratch,
                      StatusOr<PlyDocument> (*read)(const std::string&),
                      Status (*write)(const std::string&, const PlyDocument&)) {
  if (std::string fault = FaultOf(LoadCloud(path), path); !fault.empty()) return fault;
  return FaultOfRoundTrip(path, scratch, read, write);
}

// By a module; where it is not built, the reader says so.
std::string GlbFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadGlb, WriteGlb);
}

std::string PcdFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadPcd, WritePcd);
}

// VTK is tried in a process of its own, which takes long enough.
std::string VtkFault(const std::string& path, const std::string&) {
  return FaultOf(ReadVtk(path), path);
}

std::string ObjFault(const std::string& path, const std::string& scratch) {
  return MeshFault(path, scratch, ReadObj, WriteObj);
}

std::string OffFault(const std::string& path, const std::string& scratch) {
  return MeshFault(path, scratch, ReadOff, WriteOff);
}

std::string StlFault(const std::string& path, const std::string& scratch) {
  return MeshFault(path, scratch, ReadStl, WriteStl);
}

// The reader is chosen by the ending.
std::string NamedPointsFault(const std::string& path, const std::string& scratch) {
  const auto read = [](const std::string& file) { return ReadLandmarkFile(file); };
  const auto write = [](const std::string& file, const LandmarkFile& landmarks) {
    std::vector<Eigen::Vector3d> positions;
    for (const NamedLandmark& point : landmarks.points) positions.push_back(point.position);
    return WriteLandmarkFile(file, landmarks, positions);
  };
  return FaultOfRoundTrip(path, scratch, read, write);
}

std::string FramesFault(const std::string& path, const std::string&) {
  return FaultOf(ReadFrameLog(path), path);
}

// The headers of images: each reader sees each file.
std::string ImageGridFault(const std::string& path, const std::string&) {
  for (const auto read : {ReadNrrdGrid, ReadMetaImageGrid, ReadNiftiGrid}) {
    if (std::string fault = FaultOf(read(path), path); !fault.empty()) return fault;
  }
  return "";
}

std::string IniCalibrationFault(const std::string& path, const std::string&) {
  return FaultOf(ReadIniCalibration(path), path);
}

std::string IntrinsicsFault(const std::string& path, const std::string&) {
  return FaultOf(ReadIntrinsicsFile(path), path);
}

// All calibrations that are JSON: each reader sees each file.
std::string JsonCalibrationFault(const std::string& path, const std::string&) {
  for (const auto read : {ReadCamcalCalibration, ReadStirCalibration, ReadServCtCalibration}) {
    if (std::string fault = FaultOf(read(path), path); !fault.empty()) return fault;
  }
  return "";
}

std::string LandmarksFault(const std::string& path, const std::string&) {
  return FaultOf(ReadLandmarks(path, kNumVertices), path);
}

std::string LiveFault(const std::string& path, const std::string&) {
  std::vector<std::string> warnings;
  return FaultOf(ReadLiveCloud(path, 0, &warnings), path);
}

std::string LlffFault(const std::string& path, const std::string&) {
  return FaultOf(ReadLlffCamera(path, 640, 512), path);
}

std::string MatrixFault(const std::string& path, const std::string&) {
  if (std::string fault = FaultOf(ReadMatrixFile(path, 3, 3), path); !fault.empty()) return fault;
  if (std::string fault = FaultOf(ReadDistortionFile(path), path); !fault.empty()) return fault;
  return FaultOf(ReadTransformMatrix(path, 1e-3), path);
}

std::string NpyFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadNpyFile, WriteNpyFile);
}

// Colours and masks have one decoder.
std::string PictureFault(const std::string& path, const std::string&) {
  return FaultOf(ReadColorImage(path), path);
}

std::string PictureSizeFault(const std::string& path, const std::string&) {
  return FaultOf(ReadPictureSize(path), path);
}

std::string PlyFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadPly, WritePly);
}

std::string PoseMatrixFault(const std::string& path, const std::string&) {
  if (std::string fault = FaultOf(ReadPoseRows(path, 1000.0, true), path); !fault.empty()) {
    return fault;
  }
  return FaultOf(ReadPoseMatrix(path, 1000.0), path);
}

std::string PosesFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadPosesFile, WritePosesFile);
}

std::string StereoFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadStereoFile, WriteStereoFile);
}

std::string TracksFault(const std::string& path, const std::string&) {
  return FaultOf(ReadPictureTracks(path), path);
}

std::string TrajectoryFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadTrajectory, WriteTrajectory);
}

std::string WarpFault(const std::string& path, const std::string& scratch) {
  return FaultOfRoundTrip(path, scratch, ReadWarp, WriteWarp);
}

// All calibrations that are YAML: each reader sees each file.
std::string YamlCalibrationFault(const std::string& path, const std::string&) {
  if (std::string fault = FaultOf(ReadRosCalibration(path, path), path); !fault.empty()) {
    return fault;
  }
  for (const auto read : {ReadOpenCvCalibration, ReadSlamSettings}) {
    if (std::string fault = FaultOf(read(path), path); !fault.empty()) return fault;
  }
  return "";
}

}  // namespace

const std::vector<FuzzedReader>& FuzzedReaders() {
  static const std::vector<FuzzedReader> readers = {
      {"camera", ".txt", CameraFault},
      {"checkpoint", ".cbor", CheckpointFault},
      {"cloud", ".ply", CloudFault},
      {"csv", ".csv", CsvFault},
      {"depth", ".png", DepthFault},
      {"energies", ".txt", EnergiesFault},
      {"fcsv", ".fcsv", NamedPointsFault},
      {"fixed", ".txt", FixedFault},
      {"frames", ".csv", FramesFault},
      {"glb", ".glb", GlbFault},
      {"image_grid", ".image", ImageGridFault},
      {"ini_calibration", ".ini", IniCalibrationFault},
      {"intrinsics", ".txt", IntrinsicsFault},
      {"json_calibration", ".json", JsonCalibrationFault},
      {"landmarks", ".csv", LandmarksFault},
      {"live", ".ply", LiveFault},
      {"llff", ".npy", LlffFault},
      {"markups", ".json", NamedPointsFault},
      {"matrix", ".txt", MatrixFault},
      {"named_points", ".csv", NamedPointsFault},
      {"npy", ".npy", NpyFault},
      {"obj", ".obj", ObjFault},
      {"off", ".off", OffFault},
      {"pcd", ".pcd", PcdFault},
      {"picture", ".jpg", PictureFault},
      {"picture_size", ".png", PictureSizeFault},
      {"ply", ".ply", PlyFault},
      {"pose_matrix", ".txt", PoseMatrixFault},
      {"poses", ".txt", PosesFault},
      {"pts", ".pts", NamedPointsFault},
      {"stereo", ".txt", StereoFault},
      {"stl", ".stl", StlFault},
      {"tracks", ".csv", TracksFault},
      {"trajectory", ".txt", TrajectoryFault},
      {"vtk", ".vtk", VtkFault},
      {"vtp", ".vtp", VtkFault},
      {"warp", ".json", WarpFault},
      {"yaml_calibration", ".yaml", YamlCalibrationFault},
  };
  return readers;
}

const FuzzedReader* FindFuzzedReader(const std::string& name) {
  for (const FuzzedReader& reader : FuzzedReaders()) {
    if (reader.name == name) return &reader;
  }
  return nullptr;
}

namespace {

// The two files of this process, which are written over for each input: making and removing them
// would take longer than most readers do.
class ScratchFiles {
 public:
  explicit ScratchFiles(const std::string& ending)
      : base_(std::filesystem::temp_directory_path().string() + "/ceres_ed_fuzz_" +
              std::to_string(getpid())),
        path_(base_ + ending),
        written_(base_ + "_written" + ending) {}
  ~ScratchFiles() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    std::filesystem::remove(written_, ignored);
  }
  ScratchFiles(const ScratchFiles&) = delete;
  ScratchFiles& operator=(const ScratchFiles&) = delete;

  const std::string& path() const { return path_; }
  const std::string& written() const { return written_; }

  bool Fill(const std::string& bytes) const {
    const int file = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0) return false;
    const bool is_whole = write(file, bytes.data(), bytes.size()) == ssize_t(bytes.size());
    return close(file) == 0 && is_whole;
  }

 private:
  const std::string base_;
  const std::string path_;
  const std::string written_;
};

}  // namespace

std::string FaultOfBytes(const FuzzedReader& reader, const std::string& bytes) {
  // Other places that the user names come first.
  static const int named = setenv("CERES_ED_MODULES", CERES_ED_MODULE_FOLDER, /*overwrite=*/0);
  if (named != 0) return "can't name the folder of the modules";
  static std::map<std::string, ScratchFiles> files_of;
  const ScratchFiles& files = files_of.try_emplace(reader.ending, reader.ending).first->second;
  if (!files.Fill(bytes)) return "can't write " + files.path();
  return reader.fault(files.path(), files.written());
}

}  // namespace ceres_ed
