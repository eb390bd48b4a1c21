#include "apps/fit_flags.h"

#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/pipeline/fit/scale_setting.h>
#include <ceres_ed/util/options.h>

#include <utility>
#include <vector>

#include <apps/support/option_flags.h>

namespace ceres_ed {
namespace {

// The settings in the flags, with the energies as text.
struct FitFlags {
  FitSettings settings;
  bool quiet = false;
  std::string energy;
};

const OptionTable<FitSettings>& FitSettingsRows() {
  using S = FitSettings;
  static const OptionTable<S> rows({
      Row(&S::output,
          "output",
          "Mesh to write: the fitted SOURCE with all its other data; required.")
          .Letter('o')
          .File(),
      Row(&S::warp, "warp", "JSON to write: the deformation, for ed_apply.").File(),
      Row(&S::graph, "graph", "Mesh to write: the fitted nodes and edges.").File(),
      Row(&S::report, "report", "JSON to write: the settings, errors and times of the fit.").File(),
      Row(&S::html, "html", "HTML to write: the fit to look at in a browser.").File(),
      Row(&S::png, "png", "PNG to write: the same views as a picture.").File(),
      Row(&S::theme, "theme", "The ground of --png."),
      Row(&S::covariance,
          "covariance",
          "Mesh to write: covariances of points; true: only std_dev in OUT.")
          .File()
          .Alone("true"),
      Row(&S::landmarks,
          "landmarks",
          "CSV to read, rows source_index,x,y,z in the frame of TARGET.")
          .File(),
      Row(&S::source_landmarks,
          "source_landmarks",
          "Named points on SOURCE to read: .mrk.json, .fcsv, .json, .pts, .csv.")
          .File(),
      Row(&S::target_landmarks,
          "target_landmarks",
          "Those on TARGET, which are matched to them by name.")
          .File(),
      Row(&S::landmark_use, "landmark_use", "Named points draw the fit, or measure it.").Main(),
      Row(&S::mesh_space,
          "mesh_space",
          "The axes of the meshes, into which named points in RAS or LPS are turned. auto: what a "
          "mesh file says, otherwise LPS."),
      Row(&S::fixed, "fixed", "Text to read: indices of source points that must not move.").File(),
      Row(&S::plugin, "plugin", "Shared object with more energies, or several, separated by ';'.")
          .File(),
      Row(&S::scale, "scale", "A factor for SOURCE: a number, auto, or units such as mm:m.").Main(),
      Row(&S::repair, "repair", "Mend what ed_check finds and what is safe to mend.").Main(),
      Row(&S::fail_if, "fail_if", "Exit code 3 from this verdict.").Main(),
      Nested(&S::options, FitOptions::Rows()).Internal("covariance"),
  });
  return rows;
}

const OptionTable<FitFlags>& FitFlagsRows() {
  using C = FitFlags;
  static const OptionTable<C> rows({
      Row(&C::quiet, "quiet", "Show no summary and no progress bar.").Letter('q').Main(),
      Nested(&C::settings, FitSettingsRows()),
      Row(&C::energy, "energy", "More energies: NAME[:param=value,...];... (see ed_list_energies).")
          .Main(),
  });
  return rows;
}

const OptionFlags<FitFlags> kFlags(FitFlagsRows());

// Checks that there is an output, that meshes have the ending of a format, and that no two outputs
// have the same name, since one would overwrite the other.
Status CheckOutputNames(const FitSettings& settings) {
  if (settings.output.empty()) return Status::Error("flag --output is required");
  for (const std::string& mesh : {settings.output, settings.graph, settings.covariance}) {
    if (Status status = CheckMeshEnding(mesh); !status.ok()) return status;
  }
  // Nodes and covariances are points.
  for (const std::string& points : {settings.graph, settings.covariance}) {
    if (Status status = CheckHolds(points, PlyDocument()); !status.ok()) return status;
  }
  const std::string outputs[] = {settings.output,
                                 settings.warp,
                                 settings.graph,
                                 settings.report,
                                 settings.covariance,
                                 settings.html,
                                 settings.png};
  for (const std::string& one : outputs) {
    int uses = 0;
    for (const std::string& other : outputs) uses += one == other ? 1 : 0;
    if (uses > 1 && !one.empty() && one.rfind("/dev/", 0) != 0) {
      return Status::Error("'" + one + "' is the name of two outputs, expected different ones");
    }
  }
  return Status::Ok();
}

}  // namespace

StatusOr<FitCommand> ReadFitFlags() {
  StatusOr<FitFlags> read = kFlags.Read();
  if (!read.ok()) return read.status();
  FitCommand command;
  static_cast<FitSettings&>(command) = std::move(read->settings);
  command.quiet = read->quiet;
  command.options.covariance = !command.covariance.empty() && command.covariance != "false";
  if (command.covariance == "true" || command.covariance == "false") command.covariance.clear();
  if (Status status = CheckOutputNames(command); !status.ok()) return status;
  if (const auto scale = ParseScale(command.scale); !scale.ok()) return scale.status();
  StatusOr<std::vector<EnergySpec>> energies = ParseEnergySpecs(read->energy);
  if (!energies.ok()) return Status::Error("--energy: " + energies.status().message());
  command.options.extra_energies = *std::move(energies);
  std::string error;
  if (!command.options.IsValid(&error)) return Status::Error(error);
  return command;
}

}  // namespace ceres_ed
