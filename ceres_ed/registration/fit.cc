#include "ceres_ed/registration/fit.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/near_copies.h>
#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/spatial_order.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/volume.h>
#include <ceres_ed/registration/coarse_to_fine.h>
#include <ceres_ed/registration/denoise.h>
#include <ceres_ed/registration/evidence/measure_evidence.h>
#include <ceres_ed/registration/finish/fit_finish.h>
#include <ceres_ed/registration/finish/vertex_finish.h>
#include <ceres_ed/registration/fit_progress.h>
#include <ceres_ed/registration/fit_validation.h>
#include <ceres_ed/registration/normal_spread.h>
#include <ceres_ed/registration/placement.h>
#include <ceres_ed/registration/prepared_surface.h>
#include <ceres_ed/registration/sorted_input.h>
#include <ceres_ed/registration/uncertainty/fit_uncertainty.h>
#include <ceres_ed/registration/unit_frame.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

namespace ceres_ed {
namespace {

// Returns the part of the point-to-point share that a fit needs. Planes hold a body whose normals
// point everywhere, and points only delay it; they do not hold a sheet within itself.
double ShareOfPoints(const Surface& source, const Surface& target) {
  // With this spread of the normals (a third of a sphere's) the planes hold a surface.
  constexpr double kHeld = 0.1;
  constexpr double kShareOfHeld = 0.4;
  const double spread = std::min(LeastNormalSpread(source), LeastNormalSpread(target));
  return 1.0 - (1.0 - kShareOfHeld) * std::min(1.0, spread / kHeld);
}

// One fit: the steps of Fit() and the data that they share.
class Fitter {
 public:
  // `prepared` is the surface of the given source; if it is null, it is made when it is needed.
  Fitter(const FitInput& input,
         const FitOptions& options,
         const EnergyRegistry& registry,
         const PreparedSurface* prepared)
      : input_(input), options_(options), registry_(registry), prepared_source_(prepared) {}

  StatusOr<FitResult> Run();

 private:
  // Places the source, and stores both surfaces in the unit frame.
  void Place();
  // Stores the surfaces in the unit frame, with a denoised target. A fit that must stop has no use
  // for the target.
  void TakeToUnitFrame(const PointCloud& source, const PointCloud* target);
  void Report(const char* stage, double part) const {
    if (options_.on_progress) options_.on_progress({stage, PartOfFit(stage, part), 0, 0.0, 0.0});
  }
  // Returns whether the fit must end. Once it has returned true, it always does.
  bool MustStop() {
    is_interrupted_ = is_interrupted_ || (options_.should_stop && options_.should_stop());
    return is_interrupted_ || clock_.Seconds() >= options_.time_limit_s;
  }
  // Returns the options in the unit frame. `must_stop`: no stage begins any more.
  FitOptions UnitOptions(const Surface& source, const Surface* target, bool must_stop) const;
  void Finish(const UnitFit& fit, const BuiltGraph& graph, const DeformationState& state);
  void WarnAboutReflections(const DeformationState& state);
  // Measures what the result shows about its own quality.
  void MeasureQuality(const BuiltGraph& graph);

  const FitInput& input_;
  const FitOptions& options_;
  const EnergyRegistry& registry_;
  const PreparedSurface* prepared_source_;
  const Timer clock_;
  // Whether options_.should_stop has returned true while the surfaces were prepared.
  bool is_interrupted_ = false;
  Similarity unit_from_target_;
  // The pose from which the rigid stage started.
  Similarity given_;
  // The surfaces in the unit frame, and the noise of the target there. The target may be null.
  std::unique_ptr<const Surface> source_;
  std::unique_ptr<const Surface> target_;
  double noise_ = 0.0;
  FitResult result_;
};

void Fitter::Place() {
  const Timer timer;
  const bool is_placed = options_.rigid_first && input_.fixed_points.empty();
  if (is_placed) Report("rigid", 0.0);
  const auto must_stop = [this] { return MustStop(); };
  PreparedSurface made;
  if (prepared_source_ == nullptr) {
    made = PrepareSurface(input_.source, "the source", options_.num_threads, must_stop);
  }
  const PreparedSurface& source = prepared_source_ != nullptr ? *prepared_source_ : made;
  const Placement placement = PlaceSurfaces(input_, *source.surface, options_, must_stop);
  result_.rigid = placement.target_from_source;
  given_ = placement.given;
  result_.evidence.rigid_score = placement.score;
  result_.evidence.rigid_runner_up = placement.runner_up;
  result_.evidence.rigid_curvature = placement.curvature;
  for (const auto* notes : {&source.notes, &placement.notes}) {
    result_.warnings.insert(result_.warnings.end(), notes->begin(), notes->end());
  }
  result_.times.rigid = timer.Seconds();
  TakeToUnitFrame(source.surface->cloud(),
                  placement.target != nullptr ? &placement.target->cloud() : nullptr);
}

void Fitter::TakeToUnitFrame(const PointCloud& source, const PointCloud* target) {
  const Timer timer;
  PointCloud placed = Transformed(result_.rigid, source);
  unit_from_target_ = UnitFrame(placed);
  source_ = std::make_unique<Surface>(Transformed(unit_from_target_, placed), options_.num_threads);
  if (target != nullptr && !MustStop()) {
    target_ =
        std::make_unique<Surface>(Transformed(unit_from_target_, *target), options_.num_threads);
  }
  if (target_ != nullptr && !MustStop()) {
    noise_ = FinishNoise(*source_, *target_);
    result_.noise = noise_ / unit_from_target_.scale;
    Denoised denoised;
    if (options_.denoise) {
      denoised = Denoise(*target_, noise_, [this] { return MustStop(); });
      noise_ = denoised.noise;
    }
    if (denoised.length > 0.0) {
      target_ = std::make_unique<Surface>(std::move(denoised.cloud), options_.num_threads);
    }
  }
  result_.times.prepare = timer.Seconds();
}

FitOptions Fitter::UnitOptions(const Surface& source, const Surface* target, bool must_stop) const {
  FitOptions options = options_;
  options.graph.node_spacing *= unit_from_target_.scale * result_.rigid.scale;
  options.graph.num_threads = options_.num_threads;
  if (must_stop) {
    // What was left out is missing, even if should_stop returns false from now on.
    if (is_interrupted_) options.should_stop = [] { return true; };
    return options;
  }
  options.graph.volume =
      options_.volume == VolumeRule::kOn ||
      (options_.volume == VolumeRule::kAuto && EnclosesBody(source.cloud(), source.topology()));
  options.graph.volume_weight = options_.weights.volume;
  options.matching.max_distance *= unit_from_target_.scale;
  options.matching.num_threads = options_.num_threads;
  if (target != nullptr) {
    // Distances below the resolution cannot be resolved by the samples. Bare points have no edges
    // from which it could be derived, so it has a lower bound.
    const double edge =
        std::min(MeanEdgeLength(source.topology()), MeanEdgeLength(target->topology()));
    options.matching.resolution = std::max(0.1 * edge, 1e-4);
    options.weights.point_to_point_share *= ShareOfPoints(source, *target);
  }
  return options;
}

void Fitter::Finish(const UnitFit& fit, const BuiltGraph& graph, const DeformationState& state) {
  result_.warp = WarpInSourceFrame(
      graph, state, input_.source.points, unit_from_target_ * result_.rigid, result_.rigid);
  result_.skinning = graph.skinning;
  if (result_.warp.binding.neighbors == 1 || HasNearCopies(input_.source.points)) {
    // A point between two nodes belongs wholly to one of them, and rounding decides to which one;
    // it also decides which points are one, where they are apart by no more than rounding. The
    // binding in the source frame is the one that everybody else finds who applies the warp.
    StatusOr<Skinning> bound =
        BindCloudToGraph(input_.source, result_.warp.graph, result_.warp.binding);
    if (bound.ok()) result_.skinning = *std::move(bound);
  }
  PointCloud fitted = input_.source;
  const Status applied = ApplyWarp(result_.warp, result_.skinning, &fitted, options_.num_threads);
  CHECK(applied.ok()) << applied.message();
  FitFinish finish(fit, input_.source, unit_from_target_, &result_);
  const auto finite = [](const Eigen::Vector3d& point) { return point.allFinite(); };
  if (std::all_of(fitted.points.begin(), fitted.points.end(), finite)) {
    finish.FinishEveryVertex(state, &fitted);
    finish.Unfold(&fitted);
  }
  result_.points = std::move(fitted.points);
  result_.normals = std::move(fitted.normals);
  if (!std::all_of(result_.points.begin(), result_.points.end(), finite)) {
    result_.status = SolveStatus::kFailed;
    result_.message = "the warped source isn't finite";
  }
  for (const int point : input_.fixed_points) {
    result_.max_fixed_error =
        std::max(result_.max_fixed_error,
                 (result_.points[point] - result_.rigid * input_.source.points[point]).norm());
  }
  // A node alone does not fold a surface whose faces say otherwise.
  if (!input_.source.HasTriangles() || finish.has_folds()) WarnAboutReflections(state);
  for (FitRound& round : result_.rounds) round.rms_plane /= unit_from_target_.scale;
  result_.matches.rms_plane /= unit_from_target_.scale;
  result_.matches.rms_point /= unit_from_target_.scale;
  result_.matches.robust_distance /= unit_from_target_.scale;
  // The frame of the target has the same axes as the unit frame.
  for (Eigen::Matrix3d& covariance : result_.uncertainty.covariances) {
    covariance /= unit_from_target_.scale * unit_from_target_.scale;
  }
}

void Fitter::WarnAboutReflections(const DeformationState& state) {
  int reflected = 0;
  for (int j = 0; j < state.num_nodes(); ++j) {
    if (!(NodeAffine(state.node(j)).determinant() > 0.0)) ++reflected;
  }
  if (reflected == 0) return;
  result_.warnings.push_back(std::to_string(reflected) + " of " +
                             std::to_string(state.num_nodes()) +
                             " nodes turned inside out (det A <= 0): the surface is folded there");
}

void Fitter::MeasureQuality(const BuiltGraph& graph) {
  if (target_ == nullptr || !result_.IsUsable()) return;
  // A fit that was stopped before it had begun shows nothing, and its user waits.
  const bool is_stopped =
      result_.status == SolveStatus::kTimeLimit || result_.status == SolveStatus::kInterrupted;
  if (is_stopped && result_.outer_iterations == 0) return;
  std::vector<Eigen::Vector3d> points = result_.points;
  for (Eigen::Vector3d& point : points) point = unit_from_target_ * point;
  std::vector<Eigen::Vector3d> computed;
  const std::vector<Eigen::Vector3d>* normals = &result_.normals;
  if (normals->size() != points.size()) {
    // The source has triangles, from which its normals follow.
    PointCloud fitted;
    fitted.points = points;
    fitted.triangles = source_->cloud().triangles;
    computed = ComputeVertexNormals(fitted);
    normals = &computed;
  }
  MeasureEvidence(
      {source_.get(), &points, normals, target_.get(), &graph, noise_, options_.num_threads},
      &result_.evidence);
}

StatusOr<FitResult> Fitter::Run() {
  if (Status status = ValidateFit(input_, options_); !status.ok()) return status;
  // 1. The rigid placement target_from_source, and both surfaces in the unit frame.
  Place();
  std::vector<Landmark> fixed;
  for (const int point : input_.fixed_points)
    fixed.push_back({point, result_.rigid * input_.source.points[point]});
  const FitOptions unit_options = UnitOptions(*source_, target_.get(), MustStop());
  // 2. The deformation by the nodes, from coarse to fine graphs.
  const UnitFit fit = {source_.get(),
                       target_.get(),
                       &unit_options,
                       &registry_,
                       InUnitFrame(input_.landmarks, unit_from_target_),
                       InUnitFrame(fixed, unit_from_target_),
                       noise_,
                       &clock_,
                       GivenFromPlaced(result_.rigid, given_, unit_from_target_)};
  Report("graph", 0.0);
  CoarseToFine coarse_to_fine(fit);
  if (Status status = coarse_to_fine.Run(&result_); !status.ok()) return status;
  if (options_.covariance &&
      (result_.status == SolveStatus::kTimeLimit || result_.status == SolveStatus::kInterrupted)) {
    DropUncertainty("the fit ended early", &result_);
  }
  // 3. The warp in the source frame, and the finish of every vertex.
  Finish(fit, coarse_to_fine.graph(), coarse_to_fine.state());
  MeasureQuality(coarse_to_fine.graph());
  return std::move(result_);
}

// Fits large clouds in a spatial order. `prepared` is the surface of the source in that order, or
// null.
StatusOr<FitResult> FitInOrder(const FitInput& input,
                               const FitOptions& options,
                               const EnergyRegistry& registry,
                               const PreparedSurface* prepared) {
  if (!IsSorted(input.source, options) && !IsSorted(input.target, options)) {
    return Fitter(input, options, registry, prepared).Run();
  }
  // Here errors name points by the indices that the caller knows.
  if (Status status = ValidateFit(input, options); !status.ok()) return status;
  const SortedInput sorted(input, options);
  StatusOr<FitResult> result = Fitter(sorted.input(), options, registry, prepared).Run();
  if (result.ok()) sorted.PutBack(&*result);
  return result;
}

// Returns the source as a fit takes it.
PointCloud InOrder(const PointCloud& source, const FitOptions& options) {
  if (!IsSorted(source, options)) return source;
  return Reordered(source, SpatialOrder(source.points));
}

}  // namespace

StatusOr<FitResult> Fit(const FitInput& input,
                        const FitOptions& options,
                        const EnergyRegistry& registry) {
  return FitInOrder(input, options, registry, /*prepared=*/nullptr);
}

StatusOr<FitResult> Fit(const PointCloud& source, const PointCloud& target) {
  FitInput input;
  input.source = source;
  input.target = target;
  return Fit(input, {}, BuiltinEnergies());
}

SurfaceFitter::SurfaceFitter(PointCloud source,
                             const FitOptions& options,
                             const EnergyRegistry& registry)
    : source_(std::move(source)),
      options_(options),
      registry_(registry),
      prepared_(std::make_unique<const PreparedSurface>(
          PrepareSurface(InOrder(source_, options), "the source", options.num_threads))) {}

SurfaceFitter::~SurfaceFitter() = default;

StatusOr<std::unique_ptr<SurfaceFitter>> SurfaceFitter::Create(PointCloud source,
                                                               const FitOptions& options,
                                                               const EnergyRegistry& registry) {
  std::string error;
  if (!options.IsValid(&error)) return Status::Error(error);
  if (Status status = ValidateSource(source); !status.ok()) return status;
  return std::unique_ptr<SurfaceFitter>(new SurfaceFitter(std::move(source), options, registry));
}

StatusOr<FitResult> SurfaceFitter::Fit(const PointCloud& target,
                                       const std::vector<Landmark>& landmarks,
                                       const std::vector<int>& fixed_points) const {
  return FitWith(options_, target, landmarks, fixed_points);
}

StatusOr<FitResult> SurfaceFitter::FitWith(const FitOptions& options,
                                           const PointCloud& target,
                                           const std::vector<Landmark>& landmarks,
                                           const std::vector<int>& fixed_points) const {
  const FitInput input = {source_, target, landmarks, fixed_points};
  // What is prepared has the order of the points that the options of Create() ask for.
  const bool has_order = IsSorted(source_, options) == IsSorted(source_, options_);
  return FitInOrder(input, options, registry_, has_order ? prepared_.get() : nullptr);
}

}  // namespace ceres_ed
