// The options of a fit.
#ifndef CERES_ED_REGISTRATION_FIT_OPTIONS_H_
#define CERES_ED_REGISTRATION_FIT_OPTIONS_H_

#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/graph/graph_options.h>
#include <ceres_ed/solver/solver_types.h>
#include <ceres_ed/util/named_values.h>

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace ceres_ed {

// Options of the matching: which pairs are accepted.
struct MatchingOptions {
  // Pairs farther apart than this are rejected; in the unit of the surfaces, > 0, default
  // unlimited.
  double max_distance = std::numeric_limits<double>::infinity();
  // Pairs whose normals differ by more than this are rejected; degrees, (0, 180], default 75.
  double max_angle_deg = 75.0;
  // Pairs farther apart than this multiple of the robust standard deviation of all distances
  // (1.4826 times their median) are rejected; > 0, default 40.
  double max_deviations = 40.0;
  // Whether pairs are rejected whose closest point lies on a border, because the other surface
  // continues there beyond the end of this one. Default true.
  bool reject_borders = true;
  // Whether point-to-plane distances use the mean of both normals, and not the normal of the
  // target. Default true.
  bool symmetric_normals = true;
  // Pairs at most this far apart are accepted whatever the deviations are: the resolution of the
  // surfaces; >= 0, default 0.
  double resolution = 0.0;
  // Whether Matches::details are filled in. Only energies beyond the built-in ones of a fit use
  // them. Default false.
  bool with_details = false;
  // Number of threads, >= 1, default 1. The result does not depend on it.
  int num_threads = 1;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<MatchingOptions>& Rows();
};

// Options of the rigid stage.
struct RigidOptions {
  // Whether a scale is estimated, too; default false.
  bool with_scale = false;
  // The scale of the given pose: by what the source is multiplied before anything else, about the
  // origin, because its unit is another one than that of the target; finite, > 0, default 1.
  double initial_scale = 1.0;
  // Pairs whose normals differ by more than this are rejected; degrees, (0, 180], default 60.
  double max_angle_deg = 60.0;
  // The distance, as a fraction of the target's diagonal, at which a point counts half as unmatched
  // when poses are compared; > 0, default 0.03.
  double score_width = 0.03;
  // There is no search for other poses if the refined given pose misses less than this share of the
  // surface that is explained better; [0, 1], default 0.15.
  double good_score = 0.15;
  // Another pose replaces the given one only if it misses less than this share of what the given
  // pose misses, because inputs of the same sensor are usually near their place; (0, 1], default
  // 0.85.
  double preference = 0.85;
  // Whether the target may be wound inside out; default true.
  bool both_sides = true;
  // Number of threads, >= 1, default 1. The result does not depend on it.
  int num_threads = 1;
  // Called between starts; if it returns true, the search ends with the best pose so far.
  std::function<bool()> should_stop;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<RigidOptions>& Rows();
};

// Options of the finish. Lengths are in edges of the source (for bare points: in distances to the
// nearest points), so that a finish is as fine as the source is.
struct FinishOptions {
  // The number of rounds of matching, and the number of solves in each round; both >= 1, defaults 3
  // and 2.
  int rounds = 3;
  int steps = 2;
  // Waves of the displacement that are shorter than about 2 pi times this length are flattened; >
  // 0, default 1. Noise of the target makes this length longer.
  double smoothing = 1.0;
  // There is no finish if the noise requires a longer smoothing than this: the graph has already
  // fitted longer waves, and shorter ones are noise. >= 0, default 6.
  double max_smoothing = 6.0;
  // The length over which a displacement fades where nothing is matched; > 0, default 10.
  double fade = 10.0;
  // The share of point-to-point distances; the rest is point-to-plane. It keeps points from sliding
  // along the surface. [0, 1], default 0.1.
  double point_to_point_share = 0.1;
  // The width of the Welsch loss, in robust standard deviations of the distances; > 0, default 12.
  double loss_width = 12.0;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<FinishOptions>& Rows();
};

// Whether the graph fills the body within the source.
enum class VolumeRule {
  // If the source is a closed mesh.
  kAuto,
  // As far as the source encloses a body; holes are closed by a vote (InsideGrid).
  kOn,
  kOff,
};

constexpr std::array<NamedValue<VolumeRule>, 3> NamesOf(VolumeRule) {
  return {{{"auto", VolumeRule::kAuto}, {"on", VolumeRule::kOn}, {"off", VolumeRule::kOff}}};
}

// The weights of the objective (Eq. 3), all >= 0 and without unit. Each energy is a mean over its
// residuals, so that a weight has the same meaning at any scale and at any density of points and
// nodes: distances are in hundredths of the source's diagonal, and E_reg is relative to the node
// spacing.
struct FitWeights {
  double rotation = 1.0;
  double regularization = 1.0;
  // The weight of the edges to inner nodes in E_reg, relative to those along the surface.
  double volume = 0.03;
  double data = 1.0;
  double landmark = 10.0;
  double fixed = 1e4;
  // The share of the data weight that goes to point-to-point distances; the rest is point-to-plane.
  // This much for a flat sheet, and two fifths of it for a body whose normals point everywhere. [0,
  // 1], default 0.005.
  double point_to_point_share = 0.005;

  // Returns the options as data: the name, range and text of each.
  static const OptionTable<FitWeights>& Rows();
};

// The schedule of a fit, from stiff to soft and from few nodes to many. The factor of the weights
// of E_rot and E_reg starts at `initial_stiffness` and decreases in equal ratios, which are spread
// over the resolutions.
struct FitSchedule {
  // The number of graphs that are fitted one after the other, each with twice the node spacing of
  // the next; 1 to 5, default 2.
  int levels = 2;
  // The stiffness at the start; > 0, default 100. Without a target the factor is always 1.
  double initial_stiffness = 100.0;
  // The stiffness at the end for a target without noise; > 0 and at most the initial one, default
  // 0.03.
  double final_stiffness = 0.03;
  // Noise increases both stiffnesses by this factor times the cube of its standard deviation (after
  // smoothing) in hundredths of the source's diagonal. Weak noise averages out by itself. >= 0,
  // default 3000.
  double noise_stiffness = 3000.0;
  // The number of steps of stiffness on all coarser resolutions together, and on the last one; both
  // >= 1, defaults 4 and 2.
  int coarse_steps = 4;
  int fine_steps = 2;
  // The largest number of rounds of matching and solving in each step, which ends earlier if the
  // surface stands still; >= 1, default 4.
  int max_rounds = 4;
  // The surface stands still if the mean motion of the source in a round is less than this fraction
  // of its diagonal; > 0, default 2e-4.
  double tolerance = 2e-4;
  // The number of iterations of the solver in a round; >= 1, default 1.
  int solver_iterations = 1;

  // Returns the options as data: the name, range and text of each.
  static const OptionTable<FitSchedule>& Rows();
};

// The progress of a fit.
struct FitProgress {
  // "rigid" once before the source is placed, "graph" once before the graphs are built, "fit" after
  // each round of matching and solving, "finish" several times, and "unfold" once.
  std::string stage;
  // The part of the whole fit that is done, in [0, 1]; it never decreases.
  double fraction = 0.0;
  // The number of accepted pairs. In all stages but "fit", this and the values below are
  // 0.
  int inliers = 0;
  // The root mean square point-to-plane distance of the accepted pairs, in the target's unit.
  double rms_plane = 0.0;
  // The energy of the last round, without unit.
  double energy = 0.0;
};

// All options of a fit.
struct FitOptions {
  // How each round is solved.
  StrategyOptions strategy;
  // The options of the graph. node_spacing is in the unit of the source; 0 means automatic.
  GraphOptions graph;
  // Whether the graphs have nodes inside the source, too; default automatic.
  VolumeRule volume = VolumeRule::kAuto;
  // The weights of the energies, and their change during the fit.
  FitWeights weights;
  FitSchedule schedule;
  // The type of the data loss, and its width as a multiple of the robust standard deviation of the
  // residuals; > 0, defaults Welsch and 20.
  LossType loss = LossType::kWelsch;
  double loss_width = 20.0;
  // On the coarse graphs a careful way is tried as well, with a narrower loss (> 0, default 5) and
  // normals that agree better (degrees, (0, 180], default 50): limbs far from their place do not
  // move until the parts that support them are near, whereas the bold way moves them at once. The
  // fit continues with the way that leaves least to explain (hypotheses/explanation.h).
  double careful_loss_width = 5.0;
  double careful_angle_deg = 50.0;
  // The hypotheses that are tried on the coarse graphs, with commas between; empty, the default,
  // means all of them. HypothesisNames() in hypotheses/hypothesis.h returns their names.
  std::string hypotheses;
  // The options of the matching; max_distance is in the unit of the target.
  MatchingOptions matching;
  // The number of points of each surface that are matched in the last step, >= 10, default 12000.
  // The earlier steps of the last resolution use half of them, and the coarser ones an eighth, but
  // at least 1000.
  int max_samples = 12000;
  // Whether a noisy target is smoothed before it is fitted; default true.
  bool denoise = true;
  // Whether a rigid motion is searched before anything deforms; default true.
  bool rigid_first = true;
  RigidOptions rigid;
  // Additional energies, by name. Like the built-in ones they are means over their residuals.
  std::vector<EnergySpec> extra_energies;
  // Whether every point is moved onto the target at the end, beyond what the nodes can do; default
  // true. There is no finish if the fit is stopped early, or if the noise is larger than the
  // remaining distances.
  bool finish = true;
  FinishOptions finish_options;
  // Whether faces that the fit has folded over are laid flat again; default true.
  bool unfold = true;
  // Whether the determination of every source point is computed (FitResult::uncertainty); default
  // false.
  bool covariance = false;
  // Whether the energies after each round on the finest graph are kept (FitResult::rounds); default
  // false.
  bool record_rounds = false;
  // Number of threads, >= 1, default 1. The result does not depend on it.
  int num_threads = 1;
  // The wall time of the whole fit in seconds, > 0; default infinity, which means no limit.
  double time_limit_s = std::numeric_limits<double>::infinity();
  // Called often; if it returns true, the fit ends with the best state so far.
  std::function<bool()> should_stop;
  // Called with the progress of the fit.
  std::function<void(const FitProgress&)> on_progress;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<FitOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_OPTIONS_H_
