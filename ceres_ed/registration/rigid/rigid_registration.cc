#include "ceres_ed/registration/rigid/rigid_registration.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/rigid/coarse_surface.h>
#include <ceres_ed/registration/rigid/rigid_aligner.h>
#include <ceres_ed/registration/rigid/rigid_search.h>
#include <ceres_ed/registration/rigid/rigid_starts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ceres_ed {
namespace {

// Starts are selected in stages: all are refined roughly, the best of them better, and the winner
// completely.
constexpr int kSearchedStarts = 25;
constexpr int kSiftSamples = 100;
constexpr int kSiftIterations = 8;
constexpr int kSiftKept = 4;
constexpr int kCoarseSamples = 400;
constexpr int kCoarseIterations = 15;
constexpr int kFineSamples = 700;
constexpr int kFineIterations = 30;
// The samples and the iterations with which all directions are followed, and the part of the score
// that this must leave at most.
constexpr int kSlideSamples = 1000;
constexpr int kSlideIterations = 30;
constexpr double kSlidePreference = 0.995;
// The edge of the cubes of the coarse surfaces. It is a fraction of the smaller surface's diagonal,
// larger if normals turn by more than kCalmTurn from point to point (noise), and at least a
// fraction of the larger surface's diagonal.
constexpr double kSpacing = 0.025;
constexpr double kCalmTurn = 25.0 * M_PI / 180.0;
constexpr double kMaxNoiseFactor = 2.0;
constexpr double kLeastSpacing = 0.012;
// The number of smoothing passes, which is multiplied by the square of the noise factor.
constexpr double kSmoothing = 3.0;
// The side of the target is known if, at the given pose, one side misses less than the first of
// these times what the other one misses, and the best pose misses less than the second.
constexpr double kToldApart = 0.7;
constexpr double kToldBelow = 0.5;
// A pose that is turned by 180 degrees from the given one must leave this much less unmatched than
// one that is not: a body with a symmetry stays on the side on which it was given.
constexpr double kTurnPreference = 0.2;
// The scale of the given pose is a guess if the sizes then differ by more than this factor.
constexpr double kMaxSizeRatio = 2.0;
// Poses differ if they move the corners of the source by more than this share of its diagonal.
constexpr double kDifferent = 0.1;

struct ScoredPose {
  Similarity pose;
  RigidScore score;
  bool reversed = false;

  // Returns the score for a comparison of poses that the surfaces hardly tell apart: the one that
  // is turned less from `given` is believed.
  double TotalFrom(const Similarity& given) const {
    const double turn = pose.rotation.angularDistance(given.rotation) / M_PI;
    return (1.0 + kTurnPreference * turn) * score.Total();
  }
  bool IsGood(const RigidOptions& options) const { return score.Better() <= options.good_score; }
};

// How the surfaces are thinned out; the spacing is in the unit of the target.
struct Coarseness {
  double spacing = 1.0;
  int passes = 0;
};

Coarseness ChooseCoarseness(const Surface& source, const Surface& target, double scale) {
  const double source_diagonal = scale * Diagonal(source.cloud().points);
  const double target_diagonal = Diagonal(target.cloud().points);
  const auto [smaller, larger] = std::minmax(source_diagonal, target_diagonal);
  const double turn = std::max(MedianNormalTurn(source), MedianNormalTurn(target));
  const double noise_factor = std::clamp(turn / kCalmTurn, 1.0, kMaxNoiseFactor);
  Coarseness coarseness;
  coarseness.passes = static_cast<int>(std::lround(kSmoothing * noise_factor * noise_factor));
  const double spacing = std::max(kSpacing * noise_factor * smaller, kLeastSpacing * larger);
  // If all points coincide, any spacing is suitable.
  if (spacing > 0.0) coarseness.spacing = spacing;
  return coarseness;
}

RigidAlignerOptions AlignerOptions(const Surface& source,
                                   const Surface& target,
                                   const RigidOptions& options,
                                   bool reversed = false) {
  RigidAlignerOptions aligner;
  aligner.reversed = reversed;
  aligner.with_scale = options.with_scale;
  aligner.oriented = source.cloud().normals_oriented && target.cloud().normals_oriented;
  aligner.max_angle_deg = options.max_angle_deg;
  aligner.width = options.score_width * Diagonal(target.cloud().points);
  if (!(aligner.width > 0.0)) aligner.width = 1.0;
  aligner.num_threads = options.num_threads;
  return aligner;
}

// The search of AlignRigid() on coarse surfaces, before the last refinement.
class StartFinder {
 public:
  StartFinder(const Surface& source,
              const Surface& target,
              const Similarity& initial,
              const RigidOptions& options)
      : source_surface_(source),
        target_surface_(target),
        initial_(initial),
        options_(options),
        aligner_options_(AlignerOptions(source, target, options)),
        coarseness_(ChooseCoarseness(source, target, initial.scale)),
        source_(source, coarseness_.spacing / initial.scale, coarseness_.passes),
        target_(target, coarseness_.spacing, coarseness_.passes) {
    aligner_options_.slack = coarseness_.spacing;
  }

  // `reversed` takes the target inside out, here and below.
  RigidAligner Aligner(int samples, bool reversed) const {
    RigidAlignerOptions aligner = aligner_options_;
    aligner.reversed = reversed;
    return {MakeRigidSide(source_, samples), MakeRigidSide(target_, samples), aligner};
  }

  // Returns the given pose, or one that is clearly better, and counts the starts. Every pose that
  // was refined well is added to `refined`.
  ScoredPose Find(int* starts_tried, std::vector<ScoredPose>* refined) const;

 private:
  // Returns the best pose of a global search, and counts the starts.
  ScoredPose Search(bool reversed, int* starts_tried, std::vector<ScoredPose>* refined) const;
  // Returns whether the sides of the two surfaces can be told apart and the target may be reversed.
  bool HasTwoSides() const { return options_.both_sides && aligner_options_.oriented; }
  bool Stopped() const { return options_.should_stop && options_.should_stop(); }

  const Surface& source_surface_;
  const Surface& target_surface_;
  const Similarity& initial_;
  const RigidOptions& options_;
  RigidAlignerOptions aligner_options_;
  Coarseness coarseness_;
  CoarseSurface source_;
  CoarseSurface target_;
};

ScoredPose Refined(const RigidAligner& aligner, const Similarity& start, int iterations) {
  const Similarity pose = aligner.Refine(start, iterations);
  return {pose, aligner.Score(pose)};
}

ScoredPose StartFinder::Search(bool reversed,
                               int* starts_tried,
                               std::vector<ScoredPose>* refined) const {
  RigidSearchOptions search;
  search.reversed = reversed;
  search.scale = initial_.scale;
  search.oriented = aligner_options_.oriented;
  search.max_count = kSearchedStarts;
  search.should_stop = options_.should_stop;
  std::vector<Similarity> starts =
      RigidStarts(source_surface_.cloud().points, target_surface_.cloud().points, initial_);
  const std::vector<Similarity> found = SearchRigidly(source_, target_, search);
  starts.insert(starts.end(), found.begin(), found.end());
  // All starts are refined roughly.
  const RigidAligner rough = Aligner(kSiftSamples, reversed);
  const RigidAligner coarse = Aligner(kCoarseSamples, reversed);
  std::vector<ScoredPose> sifted;
  for (const Similarity& start : starts) {
    if (Stopped()) break;
    sifted.push_back(Refined(rough, start, kSiftIterations));
    ++*starts_tried;
  }
  std::stable_sort(sifted.begin(), sifted.end(), [this](const ScoredPose& a, const ScoredPose& b) {
    return a.TotalFrom(initial_) < b.TotalFrom(initial_);
  });
  // The best of them are refined better.
  if (sifted.size() > kSiftKept) sifted.resize(kSiftKept);
  ScoredPose best{initial_, RigidScore(), reversed};
  for (const ScoredPose& start : sifted) {
    if (Stopped()) break;
    ScoredPose candidate = Refined(coarse, start.pose, kCoarseIterations);
    candidate.reversed = reversed;
    refined->push_back(candidate);
    if (candidate.TotalFrom(initial_) < best.TotalFrom(initial_)) best = candidate;
  }
  return best;
}

ScoredPose StartFinder::Find(int* starts_tried, std::vector<ScoredPose>* refined) const {
  // The given pose is refined on the coarse surfaces.
  ScoredPose best = Refined(Aligner(kCoarseSamples, false), initial_, kCoarseIterations);
  *starts_tried = 1;
  refined->push_back(best);
  if (best.IsGood(options_) || Stopped()) return best;
  // Another pose, or the other side of the target, must be clearly better.
  const auto keep_better = [&](const ScoredPose& other) {
    if (other.TotalFrom(initial_) < options_.preference * best.TotalFrom(initial_)) best = other;
  };
  double ratio = 0.0;
  if (HasTwoSides()) {
    const double given = best.score.Total();
    ScoredPose reversed = Refined(Aligner(kCoarseSamples, true), initial_, kCoarseIterations);
    reversed.reversed = true;
    ++*starts_tried;
    refined->push_back(reversed);
    keep_better(reversed);
    if (best.IsGood(options_)) return best;
    ratio = best.score.Total() / std::max(given, reversed.score.Total());
  }
  const bool side = best.reversed;
  keep_better(Search(side, starts_tried, refined));
  const bool is_side_known = ratio < kToldApart && best.score.Better() < kToldBelow;
  if (HasTwoSides() && !is_side_known && !best.IsGood(options_) && !Stopped()) {
    keep_better(Search(!side, starts_tried, refined));
  }
  return best;
}

// Returns `pose`, or the pose to which it slides along itself where this explains the surfaces
// better. Directions with little curvature are held during the search, because a surface that also
// deforms slides along them for nothing. A body that does not deform has its place there, too: a
// stick with square ends along its axis, a nearly flat sheet within its plane. The borders of open
// surfaces, which usually mean nothing because a view may end anywhere, may say where it is, too.
Similarity SlideIfBetter(const Similarity& pose,
                         const Surface& source,
                         const Surface& target,
                         const RigidOptions& options,
                         bool reversed) {
  const RigidAligner aligner(MakeRigidSide(source, kSlideSamples),
                             MakeRigidSide(target, kSlideSamples),
                             AlignerOptions(source, target, options, reversed));
  Similarity best = pose;
  double least = kSlidePreference * aligner.Score(pose).Total();
  for (const auto directions : {StepDirections::kAll, StepDirections::kAllWithBorders}) {
    const Similarity slid = aligner.Refine(best, kSlideIterations, directions);
    const double score = aligner.Score(slid).Total();
    if (!(score < least)) continue;
    best = slid;
    least = kSlidePreference * score;
  }
  return best;
}

// Returns the score of the best one of the `refined` poses that differ from `best` (that move the
// corners of the source's box by more than kDifferent of its diagonal in the mean), as a multiple
// of the score of `best`. Returns -1 if there is none.
double RunnerUp(const ScoredPose& best,
                const std::vector<ScoredPose>& refined,
                const std::vector<Eigen::Vector3d>& points) {
  const Eigen::AlignedBox3d box = BoundingBox(points);
  const double different = kDifferent * best.pose.scale * box.diagonal().norm();
  double score = -1.0;
  for (const ScoredPose& other : refined) {
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d at = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      sum += (best.pose * at - other.pose * at).norm() / 8.0;
    }
    if (sum > different && (score < 0.0 || other.score.Total() < score)) {
      score = other.score.Total();
    }
  }
  return score < 0.0 ? -1.0 : score / std::max(best.score.Total(), 1e-3);
}

// Returns the root mean square distance of a surface from its centroid, weighted by area, and the
// centroid.
double SizeOf(const Surface& surface, Eigen::Vector3d* centroid) {
  const std::vector<Eigen::Vector3d>& points = surface.cloud().points;
  const std::vector<double>& areas = surface.relative_areas();
  *centroid = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    *centroid += areas[p] * points[p];
    total += areas[p];
  }
  *centroid /= total;
  double sum = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    sum += areas[p] * (points[p] - *centroid).squaredNorm();
  }
  return std::sqrt(sum / total);
}

// Returns `initial`, with another scale if the surfaces then differ in size by more than
// kMaxSizeRatio. Steps of ICP change the scale by a fifth at most, and only where pairs are found,
// so that they do not find it from another unit. The centroids are laid onto each other.
Similarity WithPlausibleScale(const Surface& source,
                              const Surface& target,
                              const Similarity& initial) {
  Eigen::Vector3d from, to;
  const double source_size = initial.scale * SizeOf(source, &from);
  const double target_size = SizeOf(target, &to);
  const double ratio = target_size / source_size;
  const bool is_plausible = ratio < kMaxSizeRatio && ratio > 1.0 / kMaxSizeRatio;
  if (is_plausible || !(ratio > 0.0) || !std::isfinite(ratio)) return initial;
  Similarity pose = initial;
  pose.scale *= ratio;
  pose.translation = to - pose.scale * (pose.rotation * from);
  return pose;
}

}  // namespace

RigidResult AlignRigid(const Surface& source,
                       const Surface& target,
                       const Similarity& given,
                       const RigidOptions& options) {
  const auto stopped = [&options] { return options.should_stop && options.should_stop(); };
  const Similarity initial = options.with_scale ? WithPlausibleScale(source, target, given) : given;
  RigidResult result;
  result.target_from_source = initial;
  if (stopped()) return result;
  const StartFinder finder(source, target, initial, options);
  std::vector<ScoredPose> refined;
  const ScoredPose best = finder.Find(&result.starts_tried, &refined);
  result.runner_up = RunnerUp(best, refined, source.cloud().points);
  result.target_from_source = best.pose;
  result.reversed = best.reversed;
  if (stopped()) return result;
  // Finally the best pose is refined on the points themselves.
  const RigidAligner fine(MakeRigidSide(source, kFineSamples),
                          MakeRigidSide(target, kFineSamples),
                          AlignerOptions(source, target, options, best.reversed));
  result.target_from_source = SlideIfBetter(
      fine.Refine(best.pose, kFineIterations), source, target, options, best.reversed);
  result.score = fine.Score(result.target_from_source).Total();
  result.curvature = fine.LeastCurvature(result.target_from_source);
  return result;
}

bool IsReversedAt(const Surface& source,
                  const Surface& target,
                  const Similarity& target_from_source,
                  const RigidOptions& options) {
  const auto score = [&](bool reversed) {
    const RigidAligner aligner(MakeRigidSide(source, kFineSamples),
                               MakeRigidSide(target, kFineSamples),
                               AlignerOptions(source, target, options, reversed));
    return aligner.Score(target_from_source).Total();
  };
  const bool has_sides = source.cloud().normals_oriented && target.cloud().normals_oriented;
  return options.both_sides && has_sides && score(true) < options.preference * score(false);
}

}  // namespace ceres_ed
