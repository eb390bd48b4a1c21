// ed_apply applies the deformation that ed_fit found to any other cloud, to landmarks, or to a
// grid.
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/pipeline/apply/warped_points.h>
#include <ceres_ed/pipeline/intention.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <apps/apply_cloud.h>
#include <apps/apply_field.h>
#include <apps/apply_landmarks.h>
#include <apps/apply_settings.h>
#include <apps/support/option_flags.h>
#include <apps/support/program.h>

namespace ceres_ed {
namespace {

const OptionTable<ApplySettings>& ApplyRows() {
  using S = ApplySettings;
  static const OptionTable<S> rows({
      Row(&S::output, "output", "File to write: the deformed IN with all its other data.")
          .Letter('o')
          .File(),
      Row(&S::source,
          "source",
          "The SOURCE of ed_fit: landmarks, and points without faces, are carried by its surface. "
          "Without it they follow the nearest nodes.")
          .File(),
      Row(&S::displacement,
          "displacement",
          "Mesh to write: IN at rest, with the displacement of each vertex.")
          .File(),
      Row(&S::mesh_space,
          "mesh_space",
          "The axes of ed_fit's meshes, into which landmarks in RAS or LPS are turned. auto: what "
          "the file of --source says, otherwise LPS.")
          .Main(),
      Nested(&S::field, FieldSettings::Rows()),
  });
  return rows;
}

const OptionFlags<ApplySettings> kFlags(ApplyRows());

// Landmarks are written in the format in which they were read.
Status CheckLandmarkOutput(const std::string& input, const ApplySettings& settings) {
  if (!settings.displacement.empty()) {
    return Status::Error("--displacement with the landmarks " + input + ", expected a mesh");
  }
  const std::string& output = settings.output;
  const std::string ending = std::filesystem::path(input).extension().string();
  if (output.empty() || std::filesystem::path(output).extension().string() == ending ||
      output.rfind("/dev/", 0) == 0) {
    return Status::Ok();
  }
  return Status::Error(output + ": expected a name that ends in " + ending + ", as " + input +
                       " does: landmarks keep their format");
}

// Checks the names of files. `input` is empty if there is none.
Status CheckNames(const std::string& input, const ApplySettings& settings) {
  const FieldSettings& field = settings.field;
  const bool wants_input = !settings.output.empty() || !settings.displacement.empty();
  if (!wants_input && !field.HasOutput()) return Status::Error("flag --output is required");
  if (wants_input && input.empty()) {
    return Status::Error("--output or --displacement without IN, expected what is to be deformed");
  }
  const std::string outputs[] = {settings.output, settings.displacement, field.field, field.rigid};
  for (const std::string& output : outputs) {
    const auto uses = std::count(std::begin(outputs), std::end(outputs), output);
    if (uses < 2 || output.empty() || output.rfind("/dev/", 0) == 0) continue;
    return Status::Error("'" + output + "' is the name of two outputs, expected different ones");
  }
  if (HasLandmarkEnding(input)) return CheckLandmarkOutput(input, settings);
  for (const std::string& output : {settings.output, settings.displacement}) {
    if (output.empty()) continue;
    if (Status status = CheckMeshEnding(output); !status.ok()) return status;
  }
  return Status::Ok();
}

Outcome Run(const std::vector<std::string>& arguments) {
  const StatusOr<ApplySettings> settings = kFlags.Read();
  if (!settings.ok()) return Outcome::Usage(settings.status().message());
  const std::string& warp_path = arguments[0];
  const std::string input = arguments.size() > 1 ? arguments[1] : "";
  if (KindOfFile(input) == FileKind::kWarp) {
    return Outcome::Usage(input +
                          " is a warp, which comes first: ed_apply WARP.json IN --output=OUT");
  }
  if (Status status = CheckNames(input, *settings); !status.ok()) {
    return Outcome::Usage(status.message());
  }
  for (const std::string& output : {settings->output, settings->displacement}) {
    if (output.empty()) continue;
    if (Status status = PrepareOutput(output); !status.ok()) return Outcome::BadInput(status);
  }
  const StatusOr<Warp> warp = LoadWarp(warp_path);
  if (!warp.ok()) return Outcome::BadInput(warp.status());
  std::optional<LoadedCloud> surface;
  if (!settings->source.empty()) {
    StatusOr<LoadedCloud> loaded = LoadFittedSurface(settings->source);
    if (!loaded.ok()) return Outcome::BadInput(loaded.status());
    surface = *std::move(loaded);
    RepairAsInFit(settings->source, *warp, &*surface);
  }
  const bool is_cloud = !input.empty() && !HasLandmarkEnding(input);
  std::optional<LoadedCloud> cloud;
  if (is_cloud) {
    StatusOr<LoadedCloud> loaded = LoadCloudToDeform(input, *warp);
    if (!loaded.ok()) return Outcome::BadInput(loaded.status());
    cloud = *std::move(loaded);
    WarnOfCloud(*cloud, input, *warp, warp_path);
  }
  if (settings->field.HasOutput()) {
    Outcome outcome =
        ApplyField(settings->field, warp_path, *warp, is_cloud ? &cloud->cloud : nullptr);
    if (!outcome.done()) return outcome;
  }
  if (settings->output.empty() && settings->displacement.empty()) return Outcome::Done();
  const LoadedCloud* carrier = surface.has_value() ? &*surface : nullptr;
  if (is_cloud) return ApplyToCloud(*settings, warp_path, *warp, *cloud, carrier);
  return ApplyToLandmarks(*settings, warp_path, *warp, input, carrier);
}

const ProgramInfo kProgram = {
    "ed_apply",
    "WARP.json [IN] [--output=OUT] [--field=FIELD.nrrd]",
    "Deforms a mesh, points, or landmarks (.mrk.json, .fcsv, .pts, .csv) with the warp that "
    "`ed_fit --warp=WARP.json` has written, for example the full resolution of a model that was "
    "fitted coarsely, or annotations on it. IN is in the frame and unit of ed_fit's SOURCE; its "
    "faces, colours and other properties are kept. --field and --rigid write the warp for other "
    "tools; IN is then what the grid surrounds.",
    "ed_apply warp.json full_resolution.ply --output=deformed.ply",
    1,
    2};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
