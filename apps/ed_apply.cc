// ed_apply applies the deformation that ed_fit found to any other cloud.
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/pipeline/apply/field_settings.h>
#include <ceres_ed/pipeline/apply/vertex_displacement.h>
#include <ceres_ed/pipeline/fit/stray_vertices.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/preflight/compare_sizes.h>
#include <ceres_ed/preflight/repair.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <apps/apply_field.h>
#include <apps/support/console.h>
#include <apps/support/option_flags.h>
#include <apps/support/program.h>

namespace ceres_ed {
namespace {

struct ApplySettings {
  std::string output;
  std::string displacement;
  FieldSettings field;
};

const OptionTable<ApplySettings>& ApplyRows() {
  using S = ApplySettings;
  static const OptionTable<S> rows({
      Row(&S::output, "output", "Mesh to write, in the format of its ending: the deformed IN with all its data.")
          .Letter('o')
          .File(),
      Row(&S::displacement,
          "displacement",
          "Mesh to write: IN at rest, with the displacement of each vertex.")
          .File(),
      Nested(&S::field, FieldSettings::Rows()),
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

// Returns what is wrong with the names of files; nothing if all is well.
std::string WrongNames(const ApplySettings& settings, bool has_cloud) {
  const FieldSettings& field = settings.field;
  const bool wants_cloud = !settings.output.empty() || !settings.displacement.empty();
  if (!wants_cloud && !field.HasOutput()) return "flag --output is required";
  if (wants_cloud && !has_cloud) {
    return "--output or --displacement without IN, expected the cloud to deform";
  }
  const std::string outputs[] = {settings.output, settings.displacement, field.field, field.rigid};
  for (const std::string& output : outputs) {
    const auto uses = std::count(std::begin(outputs), std::end(outputs), output);
    if (uses < 2 || output.empty() || output.rfind("/dev/", 0) == 0) continue;
    return "'" + output + "' is the name of two outputs, expected different ones";
  }
  return "";
}

// Warns of what was left out of the cloud, and of one that is not in the unit of the warp.
void WarnOf(const LoadedCloud& loaded,
            const std::string& in,
            const Warp& warp,
            const std::string& warp_path) {
  Console console("ed_apply", /*quiet=*/false);
  for (const std::string& warning : loaded.warnings) console.Warn(warning);
  const std::optional<SizeMismatch> mismatch = CompareSizes(
      {"the graph of " + warp_path, SizeOfGraph(warp)}, {in, Diagonal(loaded.cloud.points)});
  if (!mismatch.has_value()) return;
  console.Warn(mismatch->text + "; the warp is in the unit of ed_fit's SOURCE");
}

// Deforms the cloud, and writes it or its displacement.
Outcome WriteDeformed(const ApplySettings& settings,
                      const std::string& warp_path,
                      const Warp& warp,
                      const LoadedCloud& loaded) {
  PointCloud cloud = loaded.cloud;
  if (Status status = ApplyWarp(warp, &cloud); !status.ok()) {
    return Outcome::BadInput(Status::Error(warp_path + ": " + status.message()));
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

Outcome Run(const std::vector<std::string>& arguments) {
  const StatusOr<ApplySettings> settings = kFlags.Read();
  if (!settings.ok()) return Outcome::Usage(settings.status().message());
  const bool has_cloud = arguments.size() > 1;
  const std::string wrong = WrongNames(*settings, has_cloud);
  if (!wrong.empty()) return Outcome::Usage(wrong);
  for (const std::string& output : {settings->output, settings->displacement}) {
    if (output.empty()) continue;
    if (Status status = CheckMeshEnding(output); !status.ok()) {
      return Outcome::Usage(status.message());
    }
    if (Status status = PrepareOutput(output); !status.ok()) return Outcome::BadInput(status);
  }
  const StatusOr<Warp> warp = ReadWarp(arguments[0]);
  if (!warp.ok()) return Outcome::BadInput(warp.status());
  std::optional<LoadedCloud> loaded;
  if (has_cloud) {
    StatusOr<LoadedCloud> read = LoadCloud(arguments[1]);
    if (!read.ok()) return Outcome::BadInput(read.status());
    loaded = *std::move(read);
    // As in a fit, so that the fit's own source gives the fit's result. A list of points, however,
    // may hold annotations anywhere.
    if (loaded->cloud.HasTriangles()) LeaveOutStrayVertices(arguments[1], &*loaded);
    if (warp->repaired) {
      for (std::string& done : RepairCloud(arguments[1], &loaded->cloud)) {
        loaded->warnings.push_back(std::move(done) + ", as in the fit");
      }
    }
    WarnOf(*loaded, arguments[1], *warp, arguments[0]);
  }
  if (settings->field.HasOutput()) {
    Outcome outcome =
        ApplyField(settings->field, arguments[0], *warp, has_cloud ? &loaded->cloud : nullptr);
    if (!outcome.done()) return outcome;
  }
  if (settings->output.empty() && settings->displacement.empty()) return Outcome::Done();
  return WriteDeformed(*settings, arguments[0], *warp, *loaded);
}

const ProgramInfo kProgram = {
    "ed_apply",
    "WARP.json [IN] [--output=OUT] [--field=FIELD.nrrd]",
    "Deforms a cloud or mesh with the warp that `ed_fit --warp=WARP.json` has written, for "
    "example the full resolution of a model that was fitted coarsely, or annotations on it. IN "
    "is in the frame and unit of ed_fit's SOURCE; its faces, colours and other properties are "
    "kept. --field and --rigid write the warp for other tools; IN is then what the grid "
    "surrounds.",
    "ed_apply warp.json full_resolution.ply --output=deformed.ply",
    1,
    2};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
