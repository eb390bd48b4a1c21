// Fits one surface to another, to landmarks, or to both.
#ifndef CERES_ED_REGISTRATION_FIT_H_
#define CERES_ED_REGISTRATION_FIT_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/registration/matching.h>
#include <ceres_ed/registration/rigid_registration.h>
#include <ceres_ed/registration/vertex_finish.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/util/status.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A source point and the place that it goes to.
struct PointConstraint {
  // Index into FitInput::source.
  int point = -1;
  // In the target frame and unit.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// What is fitted to what. A fit needs a target or landmarks.
struct FitInput {
  PointCloud source;
  // Empty: landmarks alone.
  PointCloud target;
  std::vector<PointConstraint> landmarks;
  // Source points that stay where they are. They settle the frame: there is no rigid stage then.
  std::vector<int> fixed_points;
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
};

struct FitProgress {
  // "rigid", "fit".
  std::string stage;
  // In [0, 1].
  double fraction = 0.0;
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
  // Wall time of the whole fit, seconds, > 0.
  double time_limit_s = 1e9;
  // Asked often; true ends the fit with the best state so far.
  std::function<bool()> should_stop;
  std::function<void(const FitProgress&)> on_progress;

  bool IsValid(std::string* error) const;
};

// Seconds.
struct FitTimes {
  double prepare = 0.0;
  double rigid = 0.0;
  double graph = 0.0;
  double associate = 0.0;
  double build = 0.0;
  double solve = 0.0;
  double level1 = 0.0;
  double level2 = 0.0;
  // Of every vertex, unfolding included.
  double finish = 0.0;
};

// How well the data determine the warp, by the residuals of the last round and what they leave:
//   Cov(p) = s0^2 J_p (J^T J)^-1 J_p^T
// with J the Jacobian of all weighted residuals, J_p that of a warped point (solver/
// state_covariance.h) and s0^2 the variance factor of the data (solver/variance_factor.h).
// It holds on these terms: the correspondences are right, their errors independent; the rigid
// placement is known; E_rot and E_reg are Gaussian priors with their last weights, relative to the
// data; the finish and unfolding add nothing.
struct FitUncertainty {
  // Root of the trace of Cov(p), one a source point, in the source's unit; NaN where a node that
  // carries the point is undetermined. Empty where it was not asked for, or could not be had: a
  // warning says why.
  std::vector<double> std_dev;
  // s0^2, of residuals as the objective weighs them, without units.
  double variance_factor = 0.0;
  // Nodes of the warp in a direction of which nothing says anything, ascending.
  std::vector<int> undetermined_nodes;
  // Seconds.
  double time = 0.0;
};

// The outcome of a fit. It starts out failed.
struct FitResult {
  SolveStatus status = SolveStatus::kFailed;
  std::string message = "not fitted";
  // In the source frame; takes any cloud there to the target frame.
  Warp warp;
  // The binding of the source's points to the warp's nodes.
  Skinning skinning;
  // The source in the target frame and unit.
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
  Similarity rigid;
  // 1 for nodes that an observation touched in the last round.
  std::vector<char> point_relevant;
  // Of the last round, without units but for rms (target's unit; after the finish).
  Matches matches;
  EnergySummary initial_energy;
  EnergySummary final_energy;
  int outer_iterations = 0;
  int solver_iterations = 0;
  // Largest distance of a fixed point from its place, target's unit; 0 where there are none.
  double max_fixed_error = 0.0;
  // Whether the deformation explained less than the rigid placement, and was left out.
  bool rigid_only = false;
  // Standard deviation of the target's noise across its surface, in its unit.
  double noise = 0.0;
  // Faces that were folded over and were laid flat in the end.
  int unfolded = 0;
  FitUncertainty uncertainty;
  FitTimes times;
  std::vector<std::string> warnings;

  bool IsUsable() const { return status != SolveStatus::kFailed; }
};

// Fits `input`. Error: an input that can't be used, an unknown energy, bad options; the sentence
// says what was expected. A solve that fails is a result with status kFailed.
//
// The gauge: there is no camera in a fit. The rigid part is found first and held; what the nodes do
// is relative to it. Parts that nothing observes follow E_rot and E_reg.
StatusOr<FitResult> Fit(const FitInput& input,
                        const FitOptions& options,
                        const EnergyRegistry& registry);

// The same of two clouds alone, with default options and the built-in energies.
StatusOr<FitResult> Fit(const PointCloud& source, const PointCloud& target);

class Surface;

// Fits one source again and again: to the frames of a recording, to the shapes of a population.
// What depends on the source alone (normals, connectivity, what closest points are searched in) is
// made once. Results are those of Fit(), to the bit.
class SurfaceFitter {
 public:
  // `registry` must outlive it. Error: a source that can't be fitted, bad options.
  static StatusOr<std::unique_ptr<SurfaceFitter>> Create(PointCloud source,
                                                         const FitOptions& options,
                                                         const EnergyRegistry& registry);

  ~SurfaceFitter();
  SurfaceFitter(const SurfaceFitter&) = delete;
  SurfaceFitter& operator=(const SurfaceFitter&) = delete;

  const PointCloud& source() const { return source_; }

  // Fits the source to `target`; landmarks and fixed points are those of FitInput. From several
  // threads at once, too: nothing is shared that changes.
  StatusOr<FitResult> Fit(const PointCloud& target,
                          const std::vector<PointConstraint>& landmarks = {},
                          const std::vector<int>& fixed_points = {}) const;

 private:
  SurfaceFitter(PointCloud source, const FitOptions& options, const EnergyRegistry& registry);

  PointCloud source_;
  FitOptions options_;
  const EnergyRegistry& registry_;
  std::unique_ptr<const Surface> surface_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_H_
