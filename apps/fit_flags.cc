#include "apps/fit_flags.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gflags/gflags.h>

namespace ceres_ed {
namespace {

template <typename T>
struct Choice {
  const char* name;
  T value;
};
constexpr Choice<SolveMode> kModes[] = {{"batch", SolveMode::kBatch},
                                        {"two_level", SolveMode::kTwoLevel},
                                        {"marginal", SolveMode::kMarginal}};
constexpr Choice<SeamEdges> kBoundaries[] = {{"keep", SeamEdges::kKeep}, {"cut", SeamEdges::kCut}};

constexpr Choice<LinearSolver> kLinearSolvers[] = {{"ceres", LinearSolver::kCeres},
                                                   {"block", LinearSolver::kBlock}};

template <typename T, std::size_t kSize>
std::string NameOf(const Choice<T> (&choices)[kSize], T value) {
  for (const Choice<T>& choice : choices) {
    if (choice.value == value) return choice.name;
  }
  LOG(FATAL) << "unnamed choice " << static_cast<int>(value);
}

template <typename T, std::size_t kSize>
Status Choose(const char* flag, const Choice<T> (&choices)[kSize], const std::string& name, T* to) {
  std::string known;
  for (const Choice<T>& choice : choices) {
    if (name == choice.name) {
      *to = choice.value;
      return Status::Ok();
    }
    known += std::string(known.empty() ? "" : " or ") + choice.name;
  }
  return Status::Error(std::string("--") + flag + "=" + name + ", expected " + known);
}

// On the command line 0 stands for no limit.
constexpr double kNoLimit = 0.0;

double ZeroIfUnlimited(double limit) { return std::isfinite(limit) ? limit : kNoLimit; }

const FitOptions& Defaults() {
  static const FitOptions defaults;
  return defaults;
}

}  // namespace
}  // namespace ceres_ed

using ceres_ed::Defaults;

DEFINE_string(output, "", "PLY to write: SOURCE fitted, all else of it kept; required");
DEFINE_string(mode,
              ceres_ed::NameOf(ceres_ed::kModes, Defaults().strategy.mode),
              "batch: all nodes at once; two_level: observed ones first, then the rest; "
              "marginal: as batch, the rest eliminated");
DEFINE_int32(rings,
             Defaults().strategy.rings,
             "two_level, marginal: rings of unobserved nodes that level I moves too");
DEFINE_string(boundary,
              ceres_ed::NameOf(ceres_ed::kBoundaries, Defaults().strategy.seam_edges),
              "two_level: keep or cut edges across the seam of level I");
DEFINE_string(linear_solver,
              ceres_ed::NameOf(ceres_ed::kLinearSolvers, Defaults().strategy.linear_solver),
              "block: own block normal equations; ceres: ceres::Solve, the reference");
DEFINE_string(landmarks, "", "CSV of rows source_index,x,y,z: places in the target's frame");
DEFINE_string(fixed, "", "text file of source indices that must not move");
DEFINE_bool(rigid_first, Defaults().rigid_first, "find a rigid motion before anything bends");
DEFINE_bool(rigid_scale, Defaults().rigid.with_scale, "let the rigid motion scale, too");
DEFINE_double(node_spacing,
              Defaults().graph.node_spacing,
              "distance of nodes, source units; 0 = automatic");
DEFINE_int32(neighbors, Defaults().graph.neighbors, "nodes that move a point, 1 to 8");
DEFINE_double(w_rot, Defaults().weights.rotation, "weight of E_rot: each node near a rotation");
DEFINE_double(w_reg, Defaults().weights.regularization, "weight of E_reg: neighbours agree");
DEFINE_double(w_data, Defaults().weights.data, "weight of the distance to TARGET");
DEFINE_string(loss,
              ceres_ed::LossTypeName(Defaults().loss),
              "of the distance: squared huber cauchy tukey welsch geman_mcclure");
DEFINE_double(max_distance,
              ceres_ed::ZeroIfUnlimited(Defaults().matching.max_distance),
              "no match farther than this, target units; 0 = unlimited");
DEFINE_double(max_angle_deg,
              Defaults().matching.max_angle_deg,
              "no match whose normals differ by more, degrees");
DEFINE_int32(max_samples, Defaults().max_samples, "points of each surface that are matched");
DEFINE_bool(finish, Defaults().finish, "move every point onto TARGET in the end");
DEFINE_bool(covariance,
            Defaults().covariance,
            "write std_dev, source units, of each vertex (-1: nothing says)");
DEFINE_string(energy, "", "more energies, NAME[:param=value,...];... (see ed_list_energies)");
DEFINE_string(plugin, "", "shared object with more energies; several with ; between them");
DEFINE_int32(threads, Defaults().num_threads, "changes the time, not the result");
DEFINE_double(time_limit_s,
              ceres_ed::kNoLimit,
              "seconds until the best so far is written; 0 = none");
DEFINE_string(warp, "", "JSON to write: the deformation, for ed_apply");
DEFINE_string(graph, "", "PLY to write: nodes and edges, fitted");
DEFINE_string(report, "", "JSON to write: what was done and how well");
DEFINE_bool(quiet, false, "no summary, no progress bar");

namespace ceres_ed {
namespace {

Status CheckNotNegative(const char* flag, double value, const char* expected) {
  if (std::isfinite(value) && value >= 0.0) return Status::Ok();
  return Status::Error("--" + std::string(flag) + "=" +
                       gflags::GetCommandLineFlagInfoOrDie(flag).current_value + ", expected " +
                       expected);
}

Status CheckNumbers() {
  struct Number {
    const char* flag;
    double value;
    const char* expected;
  };
  const Number numbers[] = {{"w_rot", FLAGS_w_rot, "a finite number >= 0"},
                            {"w_reg", FLAGS_w_reg, "a finite number >= 0"},
                            {"w_data", FLAGS_w_data, "a finite number >= 0"},
                            {"node_spacing", FLAGS_node_spacing, "a length >= 0 (0 = automatic)"},
                            {"max_distance", FLAGS_max_distance, "a length >= 0 (0 = unlimited)"},
                            {"time_limit_s", FLAGS_time_limit_s, "seconds >= 0 (0 = no limit)"}};
  for (const Number& number : numbers) {
    Status status = CheckNotNegative(number.flag, number.value, number.expected);
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

// Two files of one name would overwrite each other.
Status CheckOutputNames(const FitSettings& settings) {
  if (settings.output.empty()) return Status::Error("flag --output is required");
  const std::string outputs[] = {settings.output, settings.warp, settings.graph, settings.report};
  for (const std::string& one : outputs) {
    int uses = 0;
    for (const std::string& other : outputs) uses += one == other ? 1 : 0;
    if (uses > 1 && !one.empty() && one.rfind("/dev/", 0) != 0) {
      return Status::Error("'" + one + "' is the name of two outputs, expected different ones");
    }
  }
  return Status::Ok();
}

Status ReadChoices(FitOptions* options) {
  Status status = Choose("mode", kModes, FLAGS_mode, &options->strategy.mode);
  if (!status.ok()) return status;
  status = Choose("boundary", kBoundaries, FLAGS_boundary, &options->strategy.seam_edges);
  if (!status.ok()) return status;
  status = Choose(
      "linear_solver", kLinearSolvers, FLAGS_linear_solver, &options->strategy.linear_solver);
  if (!status.ok()) return status;
  const StatusOr<LossType> loss = ParseLossType(FLAGS_loss);
  if (!loss.ok()) return Status::Error("--loss: " + loss.status().message());
  options->loss = *loss;
  StatusOr<std::vector<EnergySpec>> energies = ParseEnergySpecs(FLAGS_energy);
  if (!energies.ok()) return Status::Error("--energy: " + energies.status().message());
  options->extra_energies = *std::move(energies);
  return Status::Ok();
}

void ReadNumbers(FitOptions* options) {
  options->strategy.rings = FLAGS_rings;
  options->rigid_first = FLAGS_rigid_first;
  options->rigid.with_scale = FLAGS_rigid_scale;
  options->graph.node_spacing = FLAGS_node_spacing;
  options->graph.neighbors = FLAGS_neighbors;
  options->weights.rotation = FLAGS_w_rot;
  options->weights.regularization = FLAGS_w_reg;
  options->weights.data = FLAGS_w_data;
  options->matching.max_distance =
      FLAGS_max_distance > 0.0 ? FLAGS_max_distance : std::numeric_limits<double>::infinity();
  options->matching.max_angle_deg = FLAGS_max_angle_deg;
  options->max_samples = FLAGS_max_samples;
  options->finish = FLAGS_finish;
  options->covariance = FLAGS_covariance;
  options->num_threads = FLAGS_threads;
  if (FLAGS_time_limit_s > 0.0) options->time_limit_s = FLAGS_time_limit_s;
}

}  // namespace

StatusOr<FitCommand> ReadFitFlags() {
  FitCommand settings;
  settings.output = FLAGS_output;
  settings.landmarks = FLAGS_landmarks;
  settings.fixed = FLAGS_fixed;
  settings.plugin = FLAGS_plugin;
  settings.warp = FLAGS_warp;
  settings.graph = FLAGS_graph;
  settings.report = FLAGS_report;
  settings.quiet = FLAGS_quiet;
  if (Status status = CheckOutputNames(settings); !status.ok()) return status;
  if (Status status = CheckNumbers(); !status.ok()) return status;
  if (Status status = ReadChoices(&settings.options); !status.ok()) return status;
  ReadNumbers(&settings.options);
  std::string error;
  if (!settings.options.IsValid(&error)) return Status::Error(error);
  return settings;
}

}  // namespace ceres_ed
