#include "ceres_ed/io/results/live_cloud_io.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/vertex_columns.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>
#include <unordered_set>
#include <utility>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRowSize = 40;
constexpr char kExtension[] = ".ply";

// Writes little endian on every machine. Compilers turn this into a single store.
template <typename T>
void Put(T value, char** out) {
  static_assert(sizeof(T) == sizeof(std::uint32_t), "every property has four bytes");
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  for (int byte = 0; byte < 4; ++byte) *(*out)++ = static_cast<char>(bits >> (8 * byte));
}

constexpr std::size_t kMaxDigits = 9;

bool IsNumber(const std::string& text) {
  return !text.empty() && text.size() <= kMaxDigits &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

// Returns the column `name` of whole numbers >= 0 at the rows of the points.
StatusOr<std::vector<int>> WholeColumn(const std::string& path,
                                       const LoadedCloud& loaded,
                                       const char* name) {
  const PlyProperty* const property = loaded.document.Find("vertex")->Find(name);
  if (property == nullptr || property->is_list) {
    return Status::Error(path + ": no property '" + name +
                         "', expected the vertex properties id, birth_frame, bx, by, bz");
  }
  std::vector<int> column;
  column.reserve(loaded.vertex_of_point.size());
  for (const int row : loaded.vertex_of_point) {
    const double value = property->values[static_cast<std::size_t>(row)];
    if (!(value >= 0.0 && value <= std::numeric_limits<int>::max()) || value != std::floor(value)) {
      return Status::Error(path + ": vertex " + std::to_string(row) + ": " + name + " is " +
                           std::to_string(value) + ", expected a whole number >= 0");
    }
    column.push_back(static_cast<int>(value));
  }
  return column;
}

}  // namespace

Status WriteLiveCloud(const std::string& path, const std::vector<LivePoint>& points) {
  std::string contents = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                         std::to_string(points.size()) +
                         "\nproperty float x\nproperty float y\nproperty float z\n"
                         "property int id\nproperty int birth_frame\n"
                         "property float bx\nproperty float by\nproperty float bz\n"
                         "property float stability\nproperty int last_seen\nend_header\n";
  const std::size_t header_size = contents.size();
  contents.resize(header_size + kRowSize * points.size());
  char* out = contents.data() + header_size;
  for (const LivePoint& point : points) {
    for (int axis = 0; axis < 3; ++axis) Put(point.position[axis], &out);
    Put(point.id, &out);
    Put(point.birth_frame, &out);
    for (int axis = 0; axis < 3; ++axis) Put(point.birth_position[axis], &out);
    Put(point.stability, &out);
    Put(point.last_seen, &out);
  }
  return WriteFileAtomically(path, contents);
}

StatusOr<LiveSnapshot> ReadLiveCloud(const std::string& path,
                                     int frame,
                                     std::vector<std::string>* warnings) {
  StatusOr<LoadedCloud> loaded = LoadCloud(path);
  if (!loaded.ok()) return loaded.status();
  for (const std::string& warning : loaded->warnings) warnings->push_back(path + ": " + warning);
  StatusOr<std::vector<int>> ids = WholeColumn(path, *loaded, "id");
  if (!ids.ok()) return ids.status();
  StatusOr<std::vector<int>> birth_frames = WholeColumn(path, *loaded, "birth_frame");
  if (!birth_frames.ok()) return birth_frames.status();
  const PlyElement& vertices = *loaded->document.Find("vertex");
  const auto columns = FindColumns(vertices, {"bx", "by", "bz"});
  if (!columns) {
    return Status::Error(path + ": no properties bx by bz, expected where each point was at birth");
  }
  LiveSnapshot snapshot;
  snapshot.frame = frame;
  std::unordered_set<int> seen;
  for (std::size_t i = 0; i < loaded->cloud.size(); ++i) {
    const int row = loaded->vertex_of_point[i];
    snapshot.birth_points.push_back(RowOf(vertices, *columns, static_cast<std::size_t>(row)));
    if (!snapshot.birth_points.back().allFinite()) {
      return Status::Error(path + ": vertex " + std::to_string(row) +
                           ": bx by bz are not finite, expected numbers");
    }
    if (!seen.insert((*ids)[i]).second) {
      return Status::Error(path + ": vertex " + std::to_string(row) + ": id " +
                           std::to_string((*ids)[i]) + " is there twice, expected it once");
    }
  }
  const PlyProperty* const stability = vertices.Find("stability");
  const PlyProperty* const last_seen = vertices.Find("last_seen");
  if (stability != nullptr && !stability->is_list && last_seen != nullptr && !last_seen->is_list) {
    for (const int row : loaded->vertex_of_point) {
      const auto at = static_cast<std::size_t>(row);
      snapshot.stabilities.push_back(stability->values[at]);
      const double frame = last_seen->values[at];
      const bool is_known = frame >= 0.0 && frame <= std::numeric_limits<int>::max();
      snapshot.last_seen.push_back(is_known ? static_cast<int>(frame) : -1);
    }
  }
  snapshot.points = std::move(loaded->cloud.points);
  snapshot.ids = *std::move(ids);
  snapshot.birth_frames = *std::move(birth_frames);
  return snapshot;
}

std::string LiveCloudName(int frame) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.ply", frame);
  return name;
}

bool IsLiveCloudName(const std::string& name) {
  const std::size_t digits = name.size() - std::min<std::size_t>(4, name.size());
  return digits >= 6 && name.substr(digits) == ".ply" &&
         std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(digits), [](char c) {
           return std::isdigit(static_cast<unsigned char>(c)) != 0;
         });
}

StatusOr<std::map<int, std::string>> ListLiveClouds(const std::string& folder) {
  std::map<int, std::string> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const fs::path& path = it->path();
    if (path.extension() != kExtension || !IsNumber(path.stem().string())) continue;
    const auto [entry, is_new] = files.insert({std::stoi(path.stem().string()), path.string()});
    if (!is_new) {
      return Status::Error(path.string() + ": the same frame as " + entry->second +
                           ", expected one file a frame");
    }
  }
  return files;
}

}  // namespace ceres_ed
