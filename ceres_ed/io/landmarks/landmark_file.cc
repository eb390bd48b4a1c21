#include "ceres_ed/io/landmarks/landmark_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/landmarks/landmark_parsers.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

Status Parse(const std::string& path, LandmarkSide side, LandmarkFile* file) {
  const std::string ending = LandmarkEnding(path);
  if (ending == ".json") return ParseLandmarkJson(path, file);
  if (ending == ".fcsv") return ParseFcsv(path, file);
  if (ending == ".pts") return ParsePts(path, file);
  return ParseLandmarkCsv(path, side, file);
}

// Names what has none, and refuses two of the same name, since they could not be told apart.
Status CheckNames(const std::string& path, LandmarkFile* file) {
  if (file->points.empty()) {
    return Status::Error(path + ": no landmarks, expected at least one named point");
  }
  std::map<std::string, std::size_t> seen;
  for (std::size_t i = 0; i < file->points.size(); ++i) {
    std::string& name = file->points[i].name;
    name = std::string(Trim(name));
    if (name.empty()) name = std::to_string(i + 1);
    const auto [entry, is_new] = seen.insert({name, i + 1});
    if (is_new) continue;
    return Status::Error(path + ": points " + std::to_string(entry->second) + " and " +
                         std::to_string(i + 1) + " are both named " + Quoted(name) +
                         ", expected names that differ");
  }
  return Status::Ok();
}

}  // namespace

std::string LandmarkEnding(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return ending;
}

bool HasLandmarkEnding(const std::string& path) {
  const std::string ending = LandmarkEnding(path);
  return ending == ".json" || ending == ".fcsv" || ending == ".pts" || ending == ".csv";
}

StatusOr<LandmarkFile> ReadLandmarkFile(const std::string& path, LandmarkSide side) {
  StatusOr<std::string> text = ReadWholeFile(path);
  if (!text.ok()) return text.status();
  LandmarkFile file;
  file.text = *std::move(text);
  Status status = Parse(path, side, &file);
  if (status.ok()) status = CheckNames(path, &file);
  if (!status.ok()) return status;
  return file;
}

Status WriteLandmarkFile(const std::string& path,
                         const LandmarkFile& file,
                         const std::vector<Eigen::Vector3d>& positions) {
  CHECK_EQ(positions.size(), file.points.size()) << "one position a point";
  if (!file.pointers.empty()) {
    return WriteFileAtomically(path, EncodeLandmarkJson(file, positions));
  }
  std::string text;
  std::size_t end = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::array<std::size_t, 3> axes = {0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) {
      return file.places[i][a].begin < file.places[i][b].begin;
    });
    for (const std::size_t axis : axes) {
      const LandmarkFile::Place& place = file.places[i][axis];
      text.append(file.text, end, place.begin - end);
      std::string number;
      AppendNumbers({positions[i][static_cast<Eigen::Index>(axis)]}, &number);
      text += number;
      end = place.begin + place.size;
    }
  }
  text.append(file.text, end);
  return WriteFileAtomically(path, text);
}

Eigen::Vector3d BetweenSpaces(const Eigen::Vector3d& position,
                              AnatomicalSpace from,
                              AnatomicalSpace to) {
  const bool is_same =
      from == to || from == AnatomicalSpace::kUnknown || to == AnatomicalSpace::kUnknown;
  return is_same ? position : Eigen::Vector3d(-position.x(), -position.y(), position.z());
}

}  // namespace ceres_ed
