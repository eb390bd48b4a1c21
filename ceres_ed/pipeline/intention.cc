#include "ceres_ed/pipeline/intention.h"

#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/util/nearest_word.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

bool BeginsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

// Returns the names of the files in a folder, sorted; at most some thousands.
std::vector<std::string> NamesIn(const fs::path& folder) {
  constexpr std::size_t kMost = 5000;
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end;
       !error && entry != end && names.size() < kMost;
       entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool IsMeshName(const std::string& name) {
  return !fs::path(name).extension().empty() && FindMeshFormat(name) != nullptr;
}

// Returns the kind of a JSON file.
FileKind KindOfJson(const std::string& path) {
  const StatusOr<nlohmann::json> json = ReadJsonFile(path);
  if (!json.ok()) return FileKind::kOther;
  if (json->is_object() && json->value("format", nlohmann::json()) == "ceres_ed_warp") {
    return FileKind::kWarp;
  }
  if (json->is_object() && json->contains("program")) return FileKind::kReport;
  if (json->is_array() || json->contains("markups")) return FileKind::kLandmarks;
  return FileKind::kOther;
}

std::string OfMissing(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    return "there is no folder " + folder.string();
  }
  const std::string nearest = NearestWord(fs::path(path).filename().string(), NamesIn(folder));
  return nearest.empty() ? "" : "did you mean " + (folder / nearest).string() + "?";
}

std::string OfFolder(const std::string& path) {
  std::vector<std::string> meshes;
  for (const std::string& name : NamesIn(path)) {
    if (name == "depth" || name == "left") return "it looks like a sequence, which ed_slam takes";
    if (IsMeshName(name)) meshes.push_back(name);
  }
  if (meshes.empty()) return "";
  return "did you mean " + (fs::path(path) / meshes.front()).string() +
         (meshes.size() > 1 ? " or another file in it?" : "?");
}

std::string OfSurface(const std::string& path, FileKind kind) {
  switch (kind) {
    case FileKind::kMissing:
      return OfMissing(path);
    case FileKind::kFolder:
      return OfFolder(path);
    case FileKind::kWarp:
      return "it is a warp of ed_fit, with which ed_apply WARP.json IN deforms a mesh";
    case FileKind::kReport:
      return "it is a report, and no mesh";
    case FileKind::kLandmarks:
      return "it has landmarks, for --source_landmarks or --target_landmarks of ed_fit, or for "
             "ed_apply";
    case FileKind::kVolume:
      return "it is a volume: make a surface of it first, for example by 3D Slicer's segmentation "
             "and its export as a model";
    case FileKind::kPicture:
      return "it is a picture, and no mesh";
    case FileKind::kOther:
      break;
  }
  return "";
}

std::string OfWarp(const std::string& path, FileKind kind) {
  switch (kind) {
    case FileKind::kMissing:
      return OfMissing(path);
    case FileKind::kReport:
      return "it is a report; a warp is what ed_fit --warp=FILE.json writes";
    case FileKind::kLandmarks:
      return "it has landmarks: the warp comes first, as in ed_apply WARP.json IN";
    case FileKind::kFolder:
    case FileKind::kWarp:
    case FileKind::kVolume:
    case FileKind::kPicture:
    case FileKind::kOther:
      break;
  }
  return IsMeshName(path) ? "the warp comes first, as in ed_apply WARP.json IN" : "";
}

Status With(const Status& status, const std::string& intention) {
  return intention.empty() ? status : Status::Error(status.message() + "; " + intention);
}

}  // namespace

FileKind KindOfFile(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return FileKind::kMissing;
  if (fs::is_directory(status)) return FileKind::kFolder;
  std::ifstream file;
  const StatusOr<std::size_t> size = OpenRegularFile(path, &file);
  if (!size.ok()) return FileKind::kOther;
  constexpr std::size_t kStart = 512;
  std::string start(std::min(*size, kStart), '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && (start[first] == '{' || start[first] == '[')) {
    return KindOfJson(path);
  }
  // DICOM has its mark behind 128 bytes, NIfTI behind 344.
  constexpr std::size_t kDicom = 128;
  constexpr std::size_t kNifti = 344;
  const std::string_view text = start;
  const bool is_volume = BeginsWith(text, "NRRD") || BeginsWith(text, "ObjectType = Image") ||
                         BeginsWith(text.substr(std::min(kDicom, text.size())), "DICM") ||
                         BeginsWith(text.substr(std::min(kNifti, text.size())), "n+1") ||
                         (BeginsWith(text, "\x1f\x8b") && path.size() > 7 &&
                          path.substr(path.size() - 7) == ".nii.gz");
  if (is_volume) return FileKind::kVolume;
  if (BeginsWith(text, "\x89PNG") || BeginsWith(text, "\xff\xd8\xff")) return FileKind::kPicture;
  const bool is_fcsv = fs::path(path).extension() == ".fcsv";
  return is_fcsv ? FileKind::kLandmarks : FileKind::kOther;
}

StatusOr<LoadedCloud> LoadSurface(const std::string& path) {
  StatusOr<LoadedCloud> loaded = LoadCloud(path);
  if (loaded.ok()) return loaded;
  return With(loaded.status(), OfSurface(path, KindOfFile(path)));
}

StatusOr<Warp> LoadWarp(const std::string& path) {
  StatusOr<Warp> warp = ReadWarp(path);
  if (warp.ok()) return warp;
  return With(warp.status(), OfWarp(path, KindOfFile(path)));
}

}  // namespace ceres_ed
