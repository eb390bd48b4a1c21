// How a fit is done.
#ifndef CERES_ED_REGISTRATION_FIT_OPTIONS_H_
#define CERES_ED_REGISTRATION_FIT_OPTIONS_H_

#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/graph/graph_options.h>
#include <ceres_ed/solver/solver_types.h>
#include <ceres_ed/util/options_fwd.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace ceres_ed {

// Which pairs are believed.
struct MatchingOptions {
  // No pair farther apart than this, > 0, in the unit of the surfaces.
  double max_distance = std::numeric_limits<double>::infinity();
  // No pair whose normals differ by more, in (0, 180] degrees.
  double max_angle_deg = 75.0;
  // No pair farther apart than this multiple of the robust standard deviation of all distances
  // (1.4826 times their median), > 0.
  double max_deviations = 40.0;
  // No pair whose closest point lies on a border: the other surface goes on where this one ends.
  bool reject_borders = true;
  // Point-to-plane to the mean of both normals instead of the target's.
  bool symmetric_normals = true;
  // Pairs this near are kept whatever the deviations say, >= 0: the resolution of the surfaces.
  double resolution = 0.0;
  // Fill in Matches::details: what only energies beyond the built-in ones of a fit look at.
  bool with_details = false;
  // The result doesn't depend on it, >= 1.
  int num_threads = 1;

  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<MatchingOptions>& Rows();
};

struct RigidOptions {
  // Also estimate a scale.
  bool with_scale = false;
  // No pair whose normals differ by more, in (0, 180] degrees.
  double max_angle_deg = 60.0;
  // Distance, as a fraction of the target's diagonal, at which a point counts half as missed when
  // poses are compared, > 0.
  double score_width = 0.03;
  // The given pose, refined, is good enough not to search for another one when less than this of
  // the surface that is explained better is missed, in [0, 1].
  double good_score = 0.15;
  // A start that is not the given pose must beat it by this factor to be preferred, in (0, 1]:
  // inputs of the same sensor are more often near their place than not.
  double preference = 0.85;
  // The result doesn't depend on it, >= 1.
  int num_threads = 1;
  // Asked between starts; true ends the search with the best so far.
  std::function<bool()> should_stop;

  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<RigidOptions>& Rows();
};

// How a finish is done. Lengths are in edges of the source (of bare points: distances to the
// nearest ones), so that a finish is as fine as the source is.
struct FinishOptions {
  // Rounds of matching, and solves in each, >= 1.
  int rounds = 3;
  int steps = 2;
  // Waves of the displacement shorter than about 2 pi times this are flattened, > 0. Noise of the
  // target makes it longer.
  double smoothing = 1.0;
  // No finish where noise asks for a longer smoothing than this, >= 0: the graph has followed what
  // is longer, and what is shorter is noise.
  double max_smoothing = 6.0;
  // Over this length a displacement fades where nothing is matched, > 0.
  double fade = 10.0;
  // Share of point-to-point instead of point-to-plane, in [0, 1]: holds points along the surface.
  double point_to_point_share = 0.1;
  // Width of the Welsch loss, in robust standard deviations of the distances, > 0.
  double loss_width = 12.0;

  // False, with a sentence in `error`, when a value is out of range.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<FinishOptions>& Rows();
};

// Weights of the objective (Eq. 3), >= 0. Each energy is a mean over its residuals, so that a
// weight means the same at any scale and at any density of points and nodes: distances count in
// hundredths of the source's diagonal, E_reg relative to the node spacing.
struct FitWeights {
  double rotation = 1.0;
  double regularization = 1.0;
  double data = 1.0;
  double landmark = 10.0;
  double fixed = 1e4;
  // Share of the data weight that goes to point-to-point instead of point-to-plane, in [0, 1].
  double point_to_point_share = 0.005;

  // The options as data: name, range and text of each.
  static const OptionTable<FitWeights>& Rows();
};

// From stiff to soft, and from few nodes to many: E_rot and E_reg start at `initial_stiffness`
// times their weights and come down in equal ratios, spread over the levels.
struct FitSchedule {
  // Graphs that are fitted one after the other, each with twice the node spacing of the next, >= 1.
  int levels = 2;
  // > 0. Without a target the weights themselves hold from first to last.
  double initial_stiffness = 100.0;
  // What a clean target ends with, > 0 and at most the initial one.
  double final_stiffness = 0.03;
  // Noise adds to both ends: this times the cube of its standard deviation (what smoothing leaves
  // of it) in hundredths of the source's diagonal, >= 0. Weak noise averages out by itself.
  double noise_stiffness = 3000.0;
  // Steps of stiffness on the coarser levels together, and on the last one, >= 1.
  int coarse_steps = 4;
  int fine_steps = 2;
  // Rounds of matching and solving in each step, >= 1; fewer where the surface stands still.
  int max_rounds = 4;
  // Mean motion of the source in a round, as a fraction of its diagonal, that counts as standing
  // still, > 0.
  double tolerance = 2e-4;
  // Iterations of the solver in a round, >= 1.
  int solver_iterations = 1;

  // The options as data: name, range and text of each.
  static const OptionTable<FitSchedule>& Rows();
};

struct FitProgress {
  // "rigid" once before the source is placed; "fit" after each round of matching and solving.
  std::string stage;
  // In [0, 1].
  double fraction = 0.0;
  // 0 while the stage is "rigid", as are the figures below.
  int inliers = 0;
  // Of the inliers, in the target's unit.
  double rms_plane = 0.0;
  double energy = 0.0;
};

struct FitOptions {
  StrategyOptions strategy;
  // node_spacing is in the source's unit; 0 = automatic.
  GraphOptions graph;
  FitWeights weights;
  FitSchedule schedule;
  // Type of the data loss; its width follows the spread of the residuals, a multiple of their
  // robust standard deviation, > 0.
  LossType loss = LossType::kWelsch;
  double loss_width = 20.0;
  // While there are few nodes a careful way is tried, too, with a narrower loss and normals that
  // agree better (degrees): limbs that are far from their place wait until what carries them is
  // near, where the bold way fetches them at once. What leaves less unmatched goes on.
  double careful_loss_width = 5.0;
  double careful_angle_deg = 50.0;
  // max_distance is in the target's unit.
  MatchingOptions matching;
  // Points of each surface that are matched in the last step, >= 10; half of them in the steps of
  // the last level before, and an eighth on the coarser levels, but there no fewer than 1000.
  int max_samples = 12000;
  // Smooth a noisy target before it is followed.
  bool denoise = true;
  bool rigid_first = true;
  RigidOptions rigid;
  // More energies, by name; means over their residuals as the built-in ones.
  std::vector<EnergySpec> extra_energies;
  // Whether every point is moved onto the target in the end, beyond what the nodes can do. Not
  // where the fit is stopped early, nor where the noise is larger than what is left.
  bool finish = true;
  FinishOptions finish_options;
  // Lay faces flat again that the fit folded over.
  bool unfold = true;
  // Work out how well every source point is determined (FitResult::uncertainty).
  bool covariance = false;
  // The result doesn't depend on it, >= 1.
  int num_threads = 1;
  // Wall time of the whole fit, seconds, > 0; infinity: none.
  double time_limit_s = std::numeric_limits<double>::infinity();
  // Asked often; true ends the fit with the best state so far.
  std::function<bool()> should_stop;
  std::function<void(const FitProgress&)> on_progress;

  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<FitOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_OPTIONS_H_
