// ed_eval: how good a result is, against the target and, where it is known, the truth.
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/version.h>

#include <cstdio>
#include <string>
#include <vector>

#include <apps/support/evaluation_report.h>
#include <apps/support/program.h>
#include <apps/support/report.h>
#include <gflags/gflags.h>

DEFINE_string(source, "", "PLY that was fitted; measures stretched edges and flipped triangles");
DEFINE_string(truth, "", "PLY with the true place of every point of RESULT.ply, in its order");
DEFINE_string(report, "", "JSON file to write with every figure");
DEFINE_string(error_ply,
              "",
              "PLY file to write: RESULT.ply with each point's error (to truth, else target)");

namespace ceres_ed {
namespace {

Status Load(const std::string& path, PointCloud* cloud) {
  if (path.empty()) return Status::Ok();
  StatusOr<LoadedCloud> loaded = LoadCloud(path);
  if (loaded.ok()) *cloud = std::move(loaded->cloud);
  return loaded.status();
}

Outcome Run(const std::vector<std::string>& arguments) {
  PointCloud result, target, source, truth_cloud;
  for (const Status& status : {Load(arguments[0], &result),
                               Load(arguments[1], &target),
                               Load(FLAGS_source, &source),
                               Load(FLAGS_truth, &truth_cloud)}) {
    if (!status.ok()) return Outcome::BadInput(status);
  }
  const PointCloud* truth = FLAGS_truth.empty() ? nullptr : &truth_cloud;
  const StatusOr<Evaluation> evaluation =
      Evaluate(result, target, FLAGS_source.empty() ? nullptr : &source, truth);
  if (!evaluation.ok()) return Outcome::BadInput(evaluation.status());

  if (!FLAGS_report.empty()) {
    nlohmann::ordered_json report = {{"program", "ed_eval"}, {"version", kVersion}};
    report["result"] = {{"path", arguments[0]}, {"points", result.size()}};
    report["target"] = {{"path", arguments[1]}, {"points", target.size()}};
    report.update(EvaluationReport(*evaluation));
    report["flags"] = FlagsReport();
    if (Status status = WriteReport(FLAGS_report, report); !status.ok()) {
      return Outcome::BadInput(status);
    }
  }
  if (!FLAGS_error_ply.empty()) {
    const std::vector<double> errors =
        truth != nullptr ? PointDistances(result, *truth) : SurfaceDistances(result.points, target);
    if (Status status = WriteErrorCloud(FLAGS_error_ply, result, errors); !status.ok()) {
      return Outcome::BadInput(status);
    }
  }
  std::fputs(EvaluationTable(*evaluation).c_str(), stdout);
  return Outcome::Done();
}

const ProgramInfo kProgram = {"ed_eval",
                              "RESULT.ply TARGET.ply [flags]",
                              "Measures how far a fitted surface is from its target.",
                              "ed_eval fitted.ply target.ply --source=source.ply --truth=gt.ply",
                              2,
                              2};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
