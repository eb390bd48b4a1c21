#include "ceres_ed/pipeline/fit/fit_files.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/io/graph_io.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/mesh/mesh_space.h>
#include <ceres_ed/io/mesh/vertex_columns.h>
#include <ceres_ed/io/point_list_io.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/pipeline/check/check_files.h>
#include <ceres_ed/pipeline/fit/stray_vertices.h>
#include <ceres_ed/pipeline/intention.h>
#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/preflight/repair.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <utility>

namespace ceres_ed {
namespace {

int NumRows(const PlyDocument& document, const char* element) {
  const PlyElement* found = document.Find(element);
  return found == nullptr ? 0 : static_cast<int>(found->count);
}

CloudFile Describe(const std::string& path, const LoadedCloud& loaded) {
  return {path,
          NumRows(loaded.document, "vertex"),
          NumRows(loaded.document, "face"),
          Diagonal(loaded.cloud.points)};
}

// Returns for each vertex of the source's file the index of its point, or -1 if it was left out.
std::vector<int> PointsOfVertices(const FitFiles& files) {
  std::vector<int> points(files.source.points, -1);
  for (std::size_t i = 0; i < files.vertex_of_point.size(); ++i) {
    points[files.vertex_of_point[i]] = static_cast<int>(i);
  }
  return points;
}

Status LeftOut(const std::string& list, int vertex, const FitFiles& files) {
  const PlyElement& vertices = *files.source_document.Find("vertex");
  const Eigen::Vector3d at =
      RowOf(vertices, *FindPositionColumns(vertices), static_cast<std::size_t>(vertex));
  const std::string names = list + ": names vertex " + std::to_string(vertex);
  if (!at.allFinite()) {
    return Status::Error(names + ", which is not finite in " + files.source.path +
                         ", expected a finite one");
  }
  return Status::Error(names + ", which was left out of " + files.source.path +
                       " (not measured, or far from all others), expected another one");
}

void Append(const std::vector<std::string>& from, std::vector<std::string>* to) {
  to->insert(to->end(), from.begin(), from.end());
}

Status LoadLandmarks(const std::string& path, FitFiles* files) {
  if (HasLandmarkEnding(path) && std::filesystem::path(path).extension() != ".csv") {
    return Status::Error(path +
                         ": has points of one surface, expected rows source_index,x,y,z; named "
                         "points go to --source_landmarks and --target_landmarks");
  }
  const StatusOr<std::vector<Landmark>> landmarks = ReadLandmarks(path, files->source.points);
  if (!landmarks.ok()) return landmarks.status();
  const std::vector<int> points = PointsOfVertices(*files);
  for (const Landmark& landmark : *landmarks) {
    const int point = points[landmark.point];
    if (point < 0) return LeftOut(path, landmark.point, *files);
    files->input.landmarks.push_back({point, landmark.position});
  }
  return Status::Ok();
}

Status LoadNamed(const FitSettings& settings, const PlyDocument& target_document, FitFiles* files) {
  StatusOr<NamedLandmarks> named = LoadNamedLandmarks(settings,
                                                      {files->input.source, files->source_document},
                                                      {files->input.target, target_document});
  if (!named.ok()) return named.status();
  files->named = *std::move(named);
  Append(files->named.warnings, &files->warnings);
  files->named_begin = files->input.landmarks.size();
  if (settings.landmark_use == LandmarkUse::kMeasure) return Status::Ok();
  for (const Landmark& landmark : LandmarkConstraints(files->named.pairs, files->input.source)) {
    files->input.landmarks.push_back(landmark);
  }
  return Status::Ok();
}

Status LoadFixed(const std::string& path, FitFiles* files) {
  const StatusOr<std::vector<int>> vertices = ReadVertexList(path, files->source.points);
  if (!vertices.ok()) return vertices.status();
  const std::vector<int> points = PointsOfVertices(*files);
  for (const int vertex : *vertices) {
    if (points[vertex] < 0) return LeftOut(path, vertex, *files);
    files->input.fixed_points.push_back(points[vertex]);
  }
  return Status::Ok();
}

// Warns where the files name different anatomical spaces.
void WarnOfSpaces(const FitFiles& files,
                  const PlyDocument& target_document,
                  std::vector<std::string>* warnings) {
  const std::string source(SpaceMarkOf(files.source_document));
  const std::string target(SpaceMarkOf(target_document));
  if (source.empty() || target.empty() || source == target) return;
  warnings->push_back(files.source.path + " says " + source + " and " + files.target.path +
                      " says " + target +
                      ": x and y of one of them are turned, and the output, "
                      "which lies on TARGET, still says " +
                      source);
}

// Reads a cloud without its stray vertices, and mends it if `repair`.
StatusOr<LoadedCloud> LoadInput(const std::string& path, bool repair) {
  StatusOr<LoadedCloud> loaded = LoadSurface(path);
  if (!loaded.ok()) return loaded;
  LeaveOutStrayVertices(path, &*loaded);
  if (repair) Append(RepairCloud(path, &loaded->cloud), &loaded->warnings);
  return loaded;
}

// Appends scalars of the vertices, in place of those of the same name. A row whose point was left
// out, and a value that is not finite, is kUnknown, because not every reader of ASCII files accepts
// "nan".
void AddColumn(const std::string& name,
               PlyType type,
               const std::vector<int>& vertex_of_point,
               const std::vector<double>& of_points,
               PlyElement* vertices) {
  constexpr double kUnknown = -1.0;
  std::vector<double> values(vertices->count, kUnknown);
  for (std::size_t i = 0; i < of_points.size(); ++i) {
    if (std::isfinite(of_points[i])) values[vertex_of_point[i]] = of_points[i];
  }
  PlyProperty property = MakePlyScalar(name, type, std::move(values));
  if (PlyProperty* const there = vertices->Find(name); there != nullptr) {
    *there = std::move(property);
  } else {
    vertices->properties.push_back(std::move(property));
  }
}

// Returns the document of the source with a property std_dev.
PlyDocument WithDeviations(const FitFiles& files, const FitUncertainty& uncertainty) {
  PlyDocument document = files.source_document;
  AddColumn("std_dev",
            PlyType::kFloat32,
            files.vertex_of_point,
            uncertainty.StandardDeviations(),
            document.Find("vertex"));
  return document;
}

// Writes the warp, which remembers whether the source was mended.
Status WriteFittedWarp(const FitSettings& settings, const Warp& warp) {
  if (!settings.repair) return WriteWarp(settings.warp, warp);
  Warp of_mended = warp;
  of_mended.repaired = true;
  return WriteWarp(settings.warp, of_mended);
}

// Writes the vertices of the result with their covariances.
Status WriteCovariances(const std::string& path, const FitFiles& files, const FitResult& result) {
  constexpr std::array<const char*, 6> kNames = {"xx", "xy", "xz", "yy", "yz", "zz"};
  constexpr std::array<std::array<int, 2>, 6> kEntries = {
      {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
  const PlyElement& vertices = *files.source_document.Find("vertex");
  PlyDocument document;
  std::ostringstream scale;
  scale << "Covariances of x y z in the squared unit of the file, and std_dev, the root of their "
           "trace; all are -1 where nothing is known. They were multiplied by "
        << FitUncertainty::kScale << ", which was fitted to known errors.";
  document.comments = {scale.str()};
  PlyElement rows;
  rows.name = "vertex";
  rows.count = vertices.count;
  for (const char* const name : {"x", "y", "z"}) {
    rows.properties.push_back(*vertices.Find(name));
    rows.properties.back().type = PlyType::kFloat64;
  }
  const std::vector<Eigen::Matrix3d>& covariances = result.uncertainty.covariances;
  std::vector<double> values(covariances.size());
  for (std::size_t entry = 0; entry < kNames.size(); ++entry) {
    const auto [row, column] = kEntries[entry];
    for (std::size_t p = 0; p < covariances.size(); ++p) values[p] = covariances[p](row, column);
    AddColumn(kNames[entry], PlyType::kFloat64, files.vertex_of_point, values, &rows);
  }
  AddColumn("std_dev",
            PlyType::kFloat64,
            files.vertex_of_point,
            result.uncertainty.StandardDeviations(),
            &rows);
  document.elements.push_back(std::move(rows));
  return SaveCloud(path, document, files.vertex_of_point, result.points, nullptr);
}

}  // namespace

StatusOr<FitSource> LoadFitSource(const FitSettings& settings) {
  StatusOr<LoadedCloud> loaded = LoadInput(settings.source, settings.repair);
  if (!loaded.ok()) return loaded.status();
  const CloudFile file = Describe(settings.source, *loaded);
  return FitSource{file, *std::move(loaded)};
}

StatusOr<FitFiles> LoadFitFiles(const FitSettings& settings,
                                const std::function<bool()>& should_stop) {
  StatusOr<FitSource> source = LoadFitSource(settings);
  if (!source.ok()) return source.status();
  return LoadFitFiles(settings, *std::move(source), should_stop);
}

StatusOr<FitFiles> LoadFitFiles(const FitSettings& settings,
                                FitSource source,
                                const std::function<bool()>& should_stop) {
  FitFiles files;
  files.source = source.file;
  files.input.source = std::move(source.loaded.cloud);
  files.source_document = std::move(source.loaded.document);
  files.vertex_of_point = std::move(source.loaded.vertex_of_point);
  Append(source.loaded.warnings, &files.warnings);
  PlyDocument target_document;
  if (!settings.target.empty()) {
    StatusOr<LoadedCloud> target = LoadInput(settings.target, settings.repair);
    if (!target.ok()) return target.status();
    files.target = Describe(settings.target, *target);
    files.input.target = std::move(target->cloud);
    Append(target->warnings, &files.warnings);
    target_document = std::move(target->document);
  }
  if (Status status = CheckHolds(settings.output, files.source_document); !status.ok()) {
    return status;
  }
  Append(LossesOf(settings.output, files.source_document), &files.warnings);
  WarnOfSpaces(files, target_document, &files.warnings);
  files.checks = CheckFiles({settings.source, &files.input.source, &files.source_document},
                            {settings.target, &files.input.target, &target_document},
                            should_stop);
  if (!settings.landmarks.empty()) {
    if (Status status = LoadLandmarks(settings.landmarks, &files); !status.ok()) return status;
  }
  if (!settings.source_landmarks.empty()) {
    if (Status status = LoadNamed(settings, target_document, &files); !status.ok()) return status;
  }
  if (!settings.fixed.empty()) {
    if (Status status = LoadFixed(settings.fixed, &files); !status.ok()) return status;
  }
  if (settings.options.rigid_first && !files.input.fixed_points.empty()) {
    files.warnings.push_back(
        "no rigid motion is sought: --fixed determines the pose of the source");
  }
  return files;
}

Status PrepareOutputs(const FitSettings& settings) {
  Status possible = CheckLookOutputs({settings.html, settings.png, settings.theme});
  if (!possible.ok()) return possible;
  for (const std::string* path : {&settings.output,
                                  &settings.warp,
                                  &settings.graph,
                                  &settings.report,
                                  &settings.covariance,
                                  &settings.html,
                                  &settings.png}) {
    if (path->empty()) continue;
    if (Status status = PrepareOutput(*path); !status.ok()) return status;
  }
  return Status::Ok();
}

Status WriteFitFiles(const FitSettings& settings, const FitFiles& files, const FitResult& result) {
  const bool has_covariances = !result.uncertainty.covariances.empty();
  Status status =
      SaveCloud(settings.output,
                has_covariances ? WithDeviations(files, result.uncertainty) : files.source_document,
                files.vertex_of_point,
                result.points,
                result.normals.empty() ? nullptr : &result.normals);
  if (status.ok() && has_covariances && !settings.covariance.empty()) {
    status = WriteCovariances(settings.covariance, files, result);
  }
  if (status.ok() && !settings.warp.empty()) status = WriteFittedWarp(settings, result.warp);
  if (!status.ok() || settings.graph.empty()) return status;
  GraphWriteOptions options;
  options.output_from_graph = result.warp.target_from_source;
  options.is_point_relevant.assign(result.point_relevant.begin(), result.point_relevant.end());
  return WriteGraph(settings.graph, result.warp.graph, result.warp.state, options);
}

}  // namespace ceres_ed
