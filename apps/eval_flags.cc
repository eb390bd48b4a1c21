#include "apps/eval_flags.h"

#include <utility>

#include <gflags/gflags.h>

DEFINE_string(source, "", "PLY that was fitted; measures stretched edges and flipped triangles");
DEFINE_string(truth, "", "PLY with the true place of every point of RESULT.ply, in its order");
DEFINE_string(report, "", "JSON file to write with every figure");
DEFINE_string(error_ply,
              "",
              "PLY file to write: RESULT.ply with each point's error (to truth, else target)");
DEFINE_string(sequence, "", "folder of a depth sequence; measures --result instead of a pair");
DEFINE_string(result, "", "folder that ed_slam wrote for --sequence");

namespace ceres_ed {
namespace {

constexpr char kUses[] = "expected RESULT.ply TARGET.ply, or --sequence=SEQ --result=DIR";

}  // namespace

StatusOr<EvalSettings> ReadEvalFlags(const std::vector<std::string>& arguments) {
  EvalSettings settings;
  settings.source = FLAGS_source;
  settings.truth = FLAGS_truth;
  settings.error_ply = FLAGS_error_ply;
  settings.sequence = FLAGS_sequence;
  settings.result = FLAGS_result;
  settings.report = FLAGS_report;
  if (FLAGS_sequence.empty() && FLAGS_result.empty()) {
    if (arguments.size() != 2) {
      return Status::Error(std::to_string(arguments.size()) + " arguments given, " + kUses);
    }
    settings.fitted = arguments[0];
    settings.target = arguments[1];
    return settings;
  }
  if (FLAGS_result.empty()) return Status::Error("--sequence without --result, expected both");
  if (FLAGS_sequence.empty()) return Status::Error("--result without --sequence, expected both");
  if (!arguments.empty()) {
    return Status::Error("'" + arguments[0] + "' beside --sequence, " + kUses);
  }
  for (const auto& [name, value] : {std::pair("source", FLAGS_source),
                                    std::pair("truth", FLAGS_truth),
                                    std::pair("error_ply", FLAGS_error_ply)}) {
    if (!value.empty()) {
      return Status::Error("--" + std::string(name) +
                           " beside --sequence, expected it with a pair only");
    }
  }
  return settings;
}

}  // namespace ceres_ed
