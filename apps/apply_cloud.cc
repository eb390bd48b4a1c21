#include "apps/apply_cloud.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/pipeline/apply/vertex_displacement.h>
#include <ceres_ed/pipeline/apply/warped_points.h>
#include <ceres_ed/pipeline/fit/stray_vertices.h>
#include <ceres_ed/pipeline/intention.h>
#include <ceres_ed/preflight/compare_sizes.h>
#include <ceres_ed/preflight/repair.h>

#include <optional>
#include <utility>
#include <vector>

#include <apps/support/console.h>

namespace ceres_ed {
namespace {

// Returns the diagonal of the box around the nodes; 0 for a few nodes, which need not span the
// body.
double SizeOfGraph(const Warp& warp) {
  constexpr int kFewNodes = 8;
  if (warp.graph.num_nodes() < kFewNodes) return 0.0;
  Eigen::AlignedBox3d box;
  for (int j = 0; j < warp.graph.num_nodes(); ++j) box.extend(warp.graph.position(j));
  return box.diagonal().norm();
}

}  // namespace

void RepairAsInFit(const std::string& path, const Warp& warp, LoadedCloud* loaded) {
  if (!warp.repaired) return;
  for (std::string& done : RepairCloud(path, &loaded->cloud)) {
    loaded->warnings.push_back(std::move(done) + ", as in the fit");
  }
}

StatusOr<LoadedCloud> LoadCloudToDeform(const std::string& path, const Warp& warp) {
  StatusOr<LoadedCloud> loaded = LoadSurface(path);
  if (!loaded.ok()) return loaded;
  // As in a fit, so that the fit's own source gives the fit's result. A list of points, however,
  // may hold annotations anywhere.
  if (loaded->cloud.HasTriangles()) LeaveOutStrayVertices(path, &*loaded);
  RepairAsInFit(path, warp, &*loaded);
  return loaded;
}

void WarnOfCloud(const LoadedCloud& loaded,
                 const std::string& path,
                 const Warp& warp,
                 const std::string& warp_path) {
  Console console("ed_apply", /*quiet=*/false);
  for (const std::string& warning : loaded.warnings) console.Warn(warning);
  const std::optional<SizeMismatch> mismatch = CompareSizes(
      {"the graph of " + warp_path, SizeOfGraph(warp)}, {path, Diagonal(loaded.cloud.points)});
  if (!mismatch.has_value()) return;
  console.Warn(mismatch->text + "; the warp is in the unit of ed_fit's SOURCE");
}

Outcome ApplyToCloud(const ApplySettings& settings,
                     const std::string& warp_path,
                     const Warp& warp,
                     const LoadedCloud& loaded,
                     const LoadedCloud* surface) {
  PointCloud cloud = loaded.cloud;
  if (Status status = ApplyWarp(warp, &cloud); !status.ok()) {
    return Outcome::BadInput(Status::Error(warp_path + ": " + status.message()));
  }
  if (surface != nullptr && !cloud.HasTriangles()) {
    StatusOr<std::vector<Eigen::Vector3d>> carried =
        WarpedPoints(warp, warp_path, surface, loaded.cloud.points);
    if (!carried.ok()) return Outcome::BadInput(carried.status());
    cloud.points = *std::move(carried);
  }
  const std::string& output = settings.output;
  std::vector<std::string> losses;
  Status saved = Status::Ok();
  if (!output.empty()) {
    losses = LossesOf(output, loaded.document);
    saved = SaveCloud(output, loaded, cloud.points, cloud.HasNormals() ? &cloud.normals : nullptr);
  }
  if (saved.ok() && !settings.displacement.empty()) {
    const PlyDocument document = WithDisplacement(loaded, cloud.points);
    for (std::string& loss : LossesOf(settings.displacement, document)) {
      losses.push_back(std::move(loss));
    }
    saved = WriteMesh(settings.displacement, document);
  }
  if (!saved.ok()) return Outcome::BadInput(saved);

  Console console("ed_apply", /*quiet=*/false);
  for (const std::string& loss : losses) console.Warn(loss);
  const std::string deformed = std::to_string(cloud.size()) + " points deformed by " +
                               std::to_string(warp.graph.num_nodes()) + " nodes\n";
  if (!output.empty()) console.Summarize(output + ": " + deformed);
  if (!settings.displacement.empty()) {
    console.Summarize(settings.displacement + ": the displacement of " + deformed);
  }
  return Outcome::Done();
}

}  // namespace ceres_ed
