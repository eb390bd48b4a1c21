#include "ceres_ed/pipeline/report/fit_run_files.h"

#include <ceres_ed/graph/binding.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/point_list_io.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/pipeline/fit/stray_vertices.h>
#include <ceres_ed/report/html/report_json.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace ceres_ed {
namespace {

// Reads the files of one run, and keeps those points of the source that the result has, too.
class FitRunFiles {
 public:
  FitRunFiles(const FinishedRun& run, const std::string& truth) : run_(run), truth_path_(truth) {}

  FitRunView Read();

 private:
  std::optional<LoadedCloud> Load(const std::string& what, const std::string& name);
  void Miss(const std::string& what, const std::string& reason) {
    missing_.push_back("The " + what + " is not shown: " + reason + ".");
  }
  std::string Flag(const char* name) const { return TextOf(run_.report, {"flags", name}); }
  void ReadPaths();
  bool PairPoints();
  std::optional<std::vector<Eigen::Vector3d>> PointsOfRows(const LoadedCloud& cloud) const;
  void ReadTruth();
  void ReadWarpFile();
  void ReadNodes();
  void ReadDeviations();
  void ReadLandmarkFile();

  const FinishedRun& run_;
  std::string truth_path_;
  std::string source_path_;
  std::string target_path_;
  std::string result_path_;
  std::optional<LoadedCloud> source_;
  std::optional<LoadedCloud> target_;
  std::optional<LoadedCloud> result_;
  // The rows that are shown, and the places of their points.
  std::vector<int> rows_;
  PointCloud from_;
  std::vector<Eigen::Vector3d> to_;
  std::vector<Eigen::Vector3d> truth_;
  std::optional<Warp> warp_;
  std::optional<Skinning> skinning_;
  std::vector<char> point_relevant_;
  std::vector<double> deviations_;
  std::vector<GivenLandmark> landmarks_;
  std::vector<std::string> missing_;
};

std::optional<LoadedCloud> FitRunFiles::Load(const std::string& what, const std::string& name) {
  if (name.empty()) return std::nullopt;
  const std::string path = run_.Find(name);
  StatusOr<LoadedCloud> loaded = LoadCloud(path);
  if (!loaded.ok()) {
    Miss(what, loaded.status().message());
    return std::nullopt;
  }
  return *std::move(loaded);
}

// ed_fit and ed_eval name their files differently.
void FitRunFiles::ReadPaths() {
  const nlohmann::ordered_json& report = run_.report;
  target_path_ = TextOf(report, {"target", "path"});
  result_path_ = TextOf(report, {"result", "path"});
  source_path_ = TextOf(report, {"source", "path"});
  if (result_path_.empty()) result_path_ = Flag("output");
  if (source_path_.empty()) source_path_ = Flag("source");
  if (truth_path_.empty()) truth_path_ = Flag("truth");
}

// Returns the points of rows_; nothing if the file has other rows.
std::optional<std::vector<Eigen::Vector3d>> FitRunFiles::PointsOfRows(
    const LoadedCloud& cloud) const {
  std::map<int, int> point_of_row;
  for (std::size_t i = 0; i < cloud.vertex_of_point.size(); ++i) {
    point_of_row.emplace(cloud.vertex_of_point[i], static_cast<int>(i));
  }
  std::vector<Eigen::Vector3d> points;
  for (const int row : rows_) {
    const auto found = point_of_row.find(row);
    if (found == point_of_row.end()) return std::nullopt;
    points.push_back(cloud.cloud.points[found->second]);
  }
  return points;
}

// Finds the points that source and result share. Returns whether there is a result.
bool FitRunFiles::PairPoints() {
  if (!result_) return false;
  if (source_) {
    LeaveOutStrayVertices(source_path_, &*source_);
    rows_ = source_->vertex_of_point;
    from_ = source_->cloud;
    std::optional<std::vector<Eigen::Vector3d>> moved = PointsOfRows(*result_);
    if (moved) {
      to_ = *std::move(moved);
      return true;
    }
    Miss("source", source_path_ + " has other vertices than " + result_path_);
    source_.reset();
  }
  rows_ = result_->vertex_of_point;
  from_ = result_->cloud;
  to_ = result_->cloud.points;
  return true;
}

void FitRunFiles::ReadTruth() {
  const std::optional<LoadedCloud> cloud = Load("truth", truth_path_);
  if (!cloud) return;
  std::optional<std::vector<Eigen::Vector3d>> points = PointsOfRows(*cloud);
  if (points) {
    truth_ = *std::move(points);
  } else {
    Miss("truth", truth_path_ + " has other vertices than " + result_path_);
  }
}

void FitRunFiles::ReadWarpFile() {
  const std::string name = Flag("warp");
  if (name.empty() || !source_) return;
  StatusOr<Warp> warp = ReadWarp(run_.Find(name));
  if (!warp.ok()) return Miss("warp", warp.status().message());
  StatusOr<Skinning> skinning = BindCloudToGraph(from_, warp->graph, warp->binding);
  if (!skinning.ok()) return Miss("warp", name + ": " + skinning.status().message());
  warp_ = *std::move(warp);
  skinning_ = *std::move(skinning);
}

// Reads which nodes are PR.
void FitRunFiles::ReadNodes() {
  const std::string name = Flag("graph");
  if (name.empty() || !warp_) return;
  const std::optional<LoadedCloud> graph = Load("kind of the nodes", name);
  if (!graph) return;
  const PlyElement* const nodes = graph->document.Find("vertex");
  const PlyProperty* const pr = nodes != nullptr ? nodes->Find("pr") : nullptr;
  if (pr == nullptr || pr->values.size() != static_cast<std::size_t>(warp_->graph.num_nodes())) {
    return Miss("kind of the nodes", name + " has other nodes than the warp");
  }
  for (const double value : pr->values) point_relevant_.push_back(value != 0.0 ? 1 : 0);
}

void FitRunFiles::ReadDeviations() {
  const PlyElement* const vertices = result_->document.Find("vertex");
  const PlyProperty* const column = vertices != nullptr ? vertices->Find("std_dev") : nullptr;
  if (column == nullptr || column->values.size() != vertices->count) return;
  for (const int row : rows_) deviations_.push_back(column->values[row]);
}

void FitRunFiles::ReadLandmarkFile() {
  const std::string name = Flag("landmarks");
  if (name.empty()) return;
  const int count = rows_.empty() ? 0 : rows_.back() + 1;
  const StatusOr<std::vector<Landmark>> read = ReadLandmarks(run_.Find(name), count);
  if (!read.ok()) {
    missing_.push_back("The landmarks are not shown: " + read.status().message() + ".");
    return;
  }
  for (const Landmark& landmark : *read) {
    const auto at = std::lower_bound(rows_.begin(), rows_.end(), landmark.point);
    if (at == rows_.end() || *at != landmark.point) continue;
    landmarks_.push_back({"vertex " + std::to_string(landmark.point),
                          {static_cast<int>(at - rows_.begin()), landmark.position}});
  }
}

FitRunView FitRunFiles::Read() {
  ReadPaths();
  result_ = Load("result", result_path_);
  if (result_path_.empty()) Miss("result", run_.path + " names none");
  FitRunView result;
  source_ = Load("source", source_path_);
  target_ = Load("target", target_path_);
  if (PairPoints()) {
    ReadTruth();
    ReadWarpFile();
    ReadNodes();
    ReadDeviations();
    ReadLandmarkFile();
    FitParts parts;
    parts.source = source_ ? &from_ : nullptr;
    parts.target = target_ ? &target_->cloud : nullptr;
    parts.result = &to_;
    parts.triangles = &from_.triangles;
    parts.truth = truth_.empty() ? nullptr : &truth_;
    parts.warp = warp_ ? &*warp_ : nullptr;
    parts.skinning = skinning_ ? &*skinning_ : nullptr;
    parts.point_relevant = point_relevant_.empty() ? nullptr : &point_relevant_;
    parts.std_dev = std::move(deviations_);
    parts.landmarks = std::move(landmarks_);
    parts.rows = rows_;
    result.view = MakeFitView(parts);
  }
  std::vector<std::string>& notes = result.view.scene.notes;
  notes.insert(notes.begin(), missing_.begin(), missing_.end());
  result.missing = std::move(missing_);
  return result;
}

}  // namespace

FitRunView ReadFitRun(const FinishedRun& run, const std::string& truth) {
  return FitRunFiles(run, truth).Read();
}

}  // namespace ceres_ed
