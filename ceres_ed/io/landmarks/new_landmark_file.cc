// Landmark files that are written without one that was read.
#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/io/landmarks/landmark_parsers.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/util/text.h>

#include <initializer_list>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using Json = nlohmann::ordered_json;

std::string NumbersOf(const Eigen::Vector3d& position, char separator) {
  std::string text;
  for (const double value : {position.x(), position.y(), position.z()}) {
    if (!text.empty()) text += separator;
    AppendNumbers({value}, &text);
  }
  return text;
}

// Returns a field of a table with commas: quoted if it has a comma, a quote or a '#'.
std::string CsvField(const std::string& name) {
  if (name.find_first_of(",\"#") == std::string::npos) return name;
  std::string field = "\"";
  for (const char c : name) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

std::string SpaceName(AnatomicalSpace space) {
  return space == AnatomicalSpace::kRas ? "RAS" : "LPS";
}

std::string MarkupsText(const std::vector<NamedLandmark>& points, AnatomicalSpace space) {
  Json controls = Json::array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& p = points[i].position;
    controls.push_back({{"id", std::to_string(i + 1)},
                        {"label", points[i].name},
                        {"position", {p.x(), p.y(), p.z()}},
                        {"positionStatus", "defined"}});
  }
  Json markup = {{"type", "Fiducial"},
                 {"coordinateSystem", SpaceName(space)},
                 {"controlPoints", std::move(controls)}};
  const Json tree = {
      {"@schema",
       "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
       "Schema/markups-schema-v1.0.3.json#"},
      {"markups", Json::array({std::move(markup)})}};
  constexpr int kIndent = 4;
  return tree.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string FcsvText(const std::vector<NamedLandmark>& points, AnatomicalSpace space) {
  std::string text =
      "# Markups fiducial file version = 4.11\n# CoordinateSystem = " + SpaceName(space) +
      "\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += std::to_string(i + 1) + ',' + NumbersOf(points[i].position, ',') + ",0,0,0,1,1,1,0," +
            CsvField(points[i].name) + ",,\n";
  }
  return text;
}

std::string CsvText(const std::vector<NamedLandmark>& points, AnatomicalSpace space) {
  const char* const axes = space == AnatomicalSpace::kLps   ? "l,p,s"
                           : space == AnatomicalSpace::kRas ? "r,a,s"
                                                            : "x,y,z";
  std::string text = std::string("label,") + axes + '\n';
  for (const NamedLandmark& point : points) {
    text += CsvField(point.name) + ',' + NumbersOf(point.position, ',') + '\n';
  }
  return text;
}

// Words that begin the lines above the points.
bool IsHeadOfPts(std::string_view name) {
  for (const std::string_view word : {"version", "version:", "n_points:", "{", "}"}) {
    if (name == word) return true;
  }
  return false;
}

// A row is cut at blanks and commas, and ends at a '#'.
StatusOr<std::string> PtsText(const std::string& path, const std::vector<NamedLandmark>& points) {
  std::string text;
  for (const NamedLandmark& point : points) {
    if (point.name.find_first_of(", \t#") != std::string::npos || IsHeadOfPts(point.name)) {
      return Status::Error(
          path + ": .pts can't hold the name " + Quoted(point.name) +
          ", expected one without blanks, commas and '#', and none of its head (version ...)");
    }
    text += point.name + ' ' + NumbersOf(point.position, ' ') + '\n';
  }
  return text;
}

// Names are read back as they are: of one line, and without blanks around them.
Status CheckNames(const std::string& path, const std::vector<NamedLandmark>& points) {
  for (const NamedLandmark& point : points) {
    const bool is_kept = !point.name.empty() && Trim(point.name) == point.name &&
                         point.name.find_first_of("\r\n") == std::string::npos;
    if (is_kept) continue;
    return Status::Error(path + ": a landmark is named " + Quoted(point.name) +
                         ", expected a name of one line, without blanks around it");
  }
  return Status::Ok();
}

}  // namespace

Status WriteNewLandmarkFile(const std::string& path,
                            const std::vector<NamedLandmark>& points,
                            AnatomicalSpace space) {
  if (!HasLandmarkEnding(path)) {
    return Status::Error(path + ": expected a name that ends in .json, .fcsv, .pts or .csv");
  }
  if (Status status = CheckNames(path, points); !status.ok()) return status;
  const std::string ending = LandmarkEnding(path);
  const bool is_slicer = ending == ".json" || ending == ".fcsv";
  if (is_slicer && space == AnatomicalSpace::kUnknown) {
    return Status::Error(path + ": the space of the landmarks is not known, expected LPS or RAS");
  }
  if (ending == ".json") return WriteFileAtomically(path, MarkupsText(points, space));
  if (ending == ".fcsv") return WriteFileAtomically(path, FcsvText(points, space));
  if (ending == ".csv") return WriteFileAtomically(path, CsvText(points, space));
  const StatusOr<std::string> text = PtsText(path, points);
  return text.ok() ? WriteFileAtomically(path, *text) : text.status();
}

}  // namespace ceres_ed
