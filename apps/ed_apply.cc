// ed_apply applies the deformation that ed_fit found to any other cloud.
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/pipeline/fit/stray_vertices.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/preflight/compare_sizes.h>
#include <ceres_ed/preflight/repair.h>
#include <ceres_ed/util/options.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <apps/support/console.h>
#include <apps/support/option_flags.h>
#include <apps/support/program.h>

namespace ceres_ed {
namespace {

struct ApplySettings {
  std::string output;
};

const OptionTable<ApplySettings>& ApplyRows() {
  using S = ApplySettings;
  static const OptionTable<S> rows({
      Row(&S::output,
          "output",
          "PLY to write: the deformed IN.ply with all its other data; required.")
          .Letter('o')
          .File(),
  });
  return rows;
}

const OptionFlags<ApplySettings> kFlags(ApplyRows());

// Returns the diagonal of the box around the nodes; 0 for a few nodes, which need not span the
// body.
double SizeOfGraph(const Warp& warp) {
  constexpr int kFewNodes = 8;
  if (warp.graph.num_nodes() < kFewNodes) return 0.0;
  Eigen::AlignedBox3d box;
  for (int j = 0; j < warp.graph.num_nodes(); ++j) box.extend(warp.graph.position(j));
  return box.diagonal().norm();
}

Outcome Run(const std::vector<std::string>& arguments) {
  const StatusOr<ApplySettings> settings = kFlags.Read();
  if (!settings.ok()) return Outcome::Usage(settings.status().message());
  const std::string& output = settings->output;
  if (output.empty()) return Outcome::Usage("flag --output is required");
  if (Status status = PrepareOutput(output); !status.ok()) return Outcome::BadInput(status);
  const StatusOr<Warp> warp = ReadWarp(arguments[0]);
  if (!warp.ok()) return Outcome::BadInput(warp.status());
  StatusOr<LoadedCloud> loaded = LoadCloud(arguments[1]);
  if (!loaded.ok()) return Outcome::BadInput(loaded.status());

  // As in a fit, so that the fit's own source gives the fit's result. A list of points, however,
  // may hold annotations anywhere.
  if (loaded->cloud.HasTriangles()) LeaveOutStrayVertices(arguments[1], &*loaded);
  if (warp->repaired) {
    for (std::string& done : RepairCloud(arguments[1], &loaded->cloud)) {
      loaded->warnings.push_back(std::move(done) + ", as in the fit");
    }
  }
  PointCloud& cloud = loaded->cloud;
  const std::optional<SizeMismatch> mismatch = CompareSizes(
      {"the graph of " + arguments[0], SizeOfGraph(*warp)}, {arguments[1], Diagonal(cloud.points)});
  if (Status status = ApplyWarp(*warp, &cloud); !status.ok()) {
    return Outcome::BadInput(Status::Error(arguments[0] + ": " + status.message()));
  }
  const Status saved =
      SaveCloud(output, *loaded, cloud.points, cloud.HasNormals() ? &cloud.normals : nullptr);
  if (!saved.ok()) return Outcome::BadInput(saved);

  Console console("ed_apply", /*quiet=*/false);
  for (const std::string& warning : loaded->warnings) console.Warn(warning);
  if (mismatch.has_value()) {
    console.Warn(mismatch->text + "; the warp is in the unit of ed_fit's SOURCE");
  }
  console.Summarize(output + ": " + std::to_string(cloud.size()) + " points deformed by " +
                    std::to_string(warp->graph.num_nodes()) + " nodes\n");
  return Outcome::Done();
}

const ProgramInfo kProgram = {
    "ed_apply",
    "WARP.json IN.ply --output=OUT.ply",
    "Deforms a cloud or mesh with the warp that `ed_fit --warp=WARP.json` has written, for "
    "example the full resolution of a model that was fitted coarsely, or annotations on it. IN.ply "
    "is in the frame and unit of ed_fit's SOURCE; its faces, colours and other properties are "
    "kept.",
    "ed_apply warp.json full_resolution.ply --output=deformed.ply",
    2,
    2};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
