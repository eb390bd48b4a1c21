#include "apps/eval_flags.h"

#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/util/options.h>

#include <utility>

#include <apps/support/option_flags.h>

namespace ceres_ed {
namespace {

const OptionTable<EvalSettings>& EvalRows() {
  using S = EvalSettings;
  static const OptionTable<S> rows({
      Row(&S::source,
          "source",
          "Mesh that was fitted; with it, stretched edges and flipped faces are measured.")
          .File(),
      Row(&S::truth,
          "truth",
          "Mesh with the true positions of the points of RESULT, in their order.")
          .File(),
      Row(&S::calibration,
          "calibration",
          "Mesh that ed_fit --covariance has written for RESULT; with --truth, its covariances "
          "are compared with the errors.")
          .File(),
      Row(&S::sequence, "sequence", "Folder of a depth sequence, for which --result is measured.")
          .File(),
      Row(&S::result, "result", "Folder that ed_slam wrote for --sequence.").File(),
      Row(&S::report, "report", "JSON to write: all figures.").File(),
      Row(&S::html, "html", "HTML to write: the result and its errors to look at in a browser.")
          .File(),
      Row(&S::png, "png", "PNG to write: the same views as a picture.").File(),
      Row(&S::error_ply,
          "error_ply",
          "Mesh to write: RESULT with the error of each point, to the truth or the target.")
          .File(),
      NotData(&S::fitted),
      NotData(&S::target),
      NotData(&S::flags),
  });
  return rows;
}

const OptionFlags<EvalSettings> kFlags(EvalRows());

constexpr char kUses[] = "expected RESULT TARGET, or --sequence=SEQ --result=DIR";

}  // namespace

StatusOr<EvalSettings> ReadEvalFlags(const std::vector<std::string>& arguments) {
  StatusOr<EvalSettings> read = kFlags.Read();
  if (!read.ok()) return read.status();
  EvalSettings settings = *std::move(read);
  if (settings.sequence.empty() && settings.result.empty()) {
    if (arguments.size() != 2) {
      return Status::Error(std::to_string(arguments.size()) + " arguments given, " + kUses);
    }
    if (!settings.calibration.empty() && settings.truth.empty()) {
      return Status::Error("--calibration without --truth, expected both");
    }
    if (Status status = CheckMeshEnding(settings.error_ply); !status.ok()) return status;
    settings.fitted = arguments[0];
    settings.target = arguments[1];
    return settings;
  }
  if (settings.result.empty()) return Status::Error("--sequence without --result, expected both");
  if (settings.sequence.empty()) return Status::Error("--result without --sequence, expected both");
  if (!arguments.empty()) {
    return Status::Error("'" + arguments[0] + "' beside --sequence, " + kUses);
  }
  for (const auto& [name, value] : {std::pair("source", settings.source),
                                    std::pair("truth", settings.truth),
                                    std::pair("error_ply", settings.error_ply),
                                    std::pair("calibration", settings.calibration)}) {
    if (!value.empty()) {
      return Status::Error("--" + std::string(name) +
                           " beside --sequence, expected it with a pair only");
    }
  }
  return settings;
}

}  // namespace ceres_ed
