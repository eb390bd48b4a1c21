// ablate_fit: a fit with one of its ingredients left out, to see what that one is worth.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/util/timer.h>
#include <ceres_ed/version.h>

#include <cstdio>
#include <string>
#include <vector>

#include <gflags/gflags.h>

DEFINE_string(without, "", "ingredient to leave out, see --list; empty = none");
DEFINE_bool(list, false, "print every ingredient with a line on what is done without it, and end");
DEFINE_string(output, "", "PLY to write: SOURCE fitted; required");
DEFINE_string(report, "", "JSON to write: time, nodes, inliers");
DEFINE_bool(quiet, false, "no summary");

namespace ceres_ed {
namespace {

// What can be left out, and how.
struct Ingredient {
  const char* name;
  const char* without;
  void (*leave_out)(FitOptions* options);
};

constexpr Ingredient kIngredients[] = {
    {"rigid_stage",
     "nothing is placed before it bends",
     [](FitOptions* options) { options->rigid_first = false; }},
    {"two_levels",
     "one graph, the fine one",
     [](FitOptions* options) { options->schedule.levels = 1; }},
    {"careful_ways",
     "few nodes follow the bold ways alone",
     [](FitOptions* options) { options->hypotheses = "bold,intrinsic,given_bold"; }},
    {"bold_ways",
     "few nodes follow the careful ways alone",
     [](FitOptions* options) { options->hypotheses = "careful,given_careful,strict"; }},
    {"given_pose",
     "every way starts from the rigid placement",
     [](FitOptions* options) { options->hypotheses = "careful,bold,intrinsic,strict"; }},
    {"volume",
     "no nodes inside closed sources",
     [](FitOptions* options) { options->volume = VolumeRule::kOff; }},
    {"strict_way",
     "no way has stricter normals than the careful one",
     [](FitOptions* options) {
       options->hypotheses = "careful,bold,intrinsic,given_careful,given_bold";
     }},
    {"intrinsic_start",
     "no way starts from lengths along the surfaces",
     [](FitOptions* options) {
       options->hypotheses = "careful,bold,given_careful,given_bold,strict";
     }},
    {"robust_loss",
     "squared distances while nodes move",
     [](FitOptions* options) { options->loss = LossType::kSquared; }},
    {"annealing",
     "as soft from the first step as in the last",
     [](FitOptions* options) {
       options->schedule.initial_stiffness = options->schedule.final_stiffness;
     }},
    {"soft_end",
     "E_rot and E_reg end at their weights, not far below",
     [](FitOptions* options) { options->schedule.final_stiffness = 1.0; }},
    {"noise_stiffness",
     "a noisy target is followed as softly as a clean one",
     [](FitOptions* options) { options->schedule.noise_stiffness = 0.0; }},
    {"denoising",
     "a noisy target is followed as it is",
     [](FitOptions* options) { options->denoise = false; }},
    {"unfolding", "faces stay folded", [](FitOptions* options) { options->unfold = false; }},
    {"symmetric_normals",
     "planes have the target's normals alone while nodes move",
     [](FitOptions* options) { options->matching.symmetric_normals = false; }},
    {"normal_test",
     "pairs are believed whatever their normals",
     [](FitOptions* options) {
       options->matching.max_angle_deg = 180.0;
       options->careful_angle_deg = 180.0;
     }},
    {"border_test",
     "pairs on borders are believed while nodes move",
     [](FitOptions* options) { options->matching.reject_borders = false; }},
    {"distance_test",
     "pairs are believed however far apart",
     [](FitOptions* options) { options->matching.max_deviations = 1e9; }},
    {"samples",
     "a quarter of the points is matched on the last level",
     [](FitOptions* options) { options->max_samples = 1500; }},
    {"small_point_share",
     "point-to-point has a tenth of the data weight",
     [](FitOptions* options) { options->weights.point_to_point_share = 0.1; }},
    {"point_share",
     "no point-to-point",
     [](FitOptions* options) { options->weights.point_to_point_share = 0.0; }},
    {"finish",
     "points stay where the nodes bring them",
     [](FitOptions* options) { options->finish = false; }},
};

void PrintIngredients() {
  for (const Ingredient& ingredient : kIngredients) {
    std::printf("%s %s\n", ingredient.name, ingredient.without);
  }
}

Status LeaveOut(const std::string& name, FitOptions* options) {
  if (name.empty()) return Status::Ok();
  std::string known;
  for (const Ingredient& ingredient : kIngredients) {
    if (name == ingredient.name) {
      ingredient.leave_out(options);
      return Status::Ok();
    }
    known += std::string(" ") + ingredient.name;
  }
  return Status::Error("--without=" + name + ", expected one of" + known);
}

// As ed_fit's report has them, so that scripts read both alike.
Status Report(const FitResult& fit, double seconds) {
  if (FLAGS_report.empty()) return Status::Ok();
  return WriteReport(FLAGS_report,
                     {{"program", "ablate_fit"},
                      {"version", kVersion},
                      {"status", NameOf(fit.status)},
                      {"nodes", {{"total", fit.warp.graph.num_nodes()}}},
                      {"inliers", fit.matches.inliers},
                      {"time_s", {{"total", seconds}}}});
}

int Fail(int code, const std::string& message) {
  std::fprintf(stderr, "ablate_fit: %s\n", message.c_str());
  return code;
}

// Returns the exit code: that of ed_fit in the same case.
int Run(const std::vector<std::string>& arguments) {
  constexpr int kUsage = 1;
  constexpr int kBadInput = 2;
  constexpr int kNoResult = 3;
  const Timer clock;
  FitOptions options;
  if (Status status = LeaveOut(FLAGS_without, &options); !status.ok()) {
    return Fail(kUsage, status.message());
  }
  if (arguments.size() != 2 || FLAGS_output.empty()) {
    return Fail(kUsage, "expected SOURCE.ply, TARGET.ply and --output");
  }
  const StatusOr<LoadedCloud> source = LoadCloud(arguments[0]);
  if (!source.ok()) return Fail(kBadInput, source.status().message());
  const StatusOr<LoadedCloud> target = LoadCloud(arguments[1]);
  if (!target.ok()) return Fail(kBadInput, target.status().message());
  FitInput input;
  input.source = source->cloud;
  input.target = target->cloud;
  const EnergyRegistry registry = BuiltinEnergies();
  const StatusOr<FitResult> fit = Fit(input, options, registry);
  if (!fit.ok()) return Fail(kBadInput, fit.status().message());
  if (!fit->IsUsable()) return Fail(kNoResult, fit->message);
  Status status = SaveCloud(FLAGS_output, *source, fit->points, &fit->normals);
  const double seconds = clock.Seconds();
  if (status.ok()) status = Report(*fit, seconds);
  if (!status.ok()) return Fail(kBadInput, status.message());
  if (!FLAGS_quiet) {
    const std::string name = FLAGS_without.empty() ? "nothing" : FLAGS_without;
    std::printf("without %s: %s, %.2f s\n", name.c_str(), fit->message.c_str(), seconds);
  }
  return 0;
}

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  gflags::SetUsageMessage("ablate_fit SOURCE.ply TARGET.ply --output=OUT.ply [--without=NAME]");
  gflags::ParseCommandLineFlags(&argc, &argv, /*remove_flags=*/true);
  if (FLAGS_list) {
    ceres_ed::PrintIngredients();
    return 0;
  }
  return ceres_ed::Run({argv + 1, argv + argc});
}
