#include "ceres_ed/registration/rigid/rigid_search.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/sampling.h>
#include <ceres_ed/registration/rigid/nearest_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

constexpr int kTurns = 24;
constexpr int kSamples = 64;
// So many samples decide whether the others are looked at.
constexpr int kFirstSamples = 16;
// Lengths as fractions of the smaller surface's diagonal: between places that are tried; at which a
// point counts half as missed; of a cell of the grid; beyond which a point is missed.
constexpr double kPlaceSpacing = 0.06;
constexpr double kWidth = 0.05;
constexpr double kCell = 0.035;
constexpr double kReach = 0.12;
// Places are tried farther apart rather than more of them.
constexpr int kMaxPlaces = 800;
constexpr double kAngleWidth = 30.0 * M_PI / 180.0;
// Poses that take the smaller surface's ends this close together (fraction of its diagonal, root
// mean square) are one.
constexpr double kAlike = 0.08;

struct Moments {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  // Columns by descending variance, each as long as the deviation along it.
  Eigen::Matrix3d deviations;
};

Moments MomentsOf(const std::vector<Eigen::Vector3d>& points) {
  Moments moments;
  for (const Eigen::Vector3d& point : points) moments.mean += point;
  moments.mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    covariance += (point - moments.mean) * (point - moments.mean).transpose();
  }
  covariance /= static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  for (int i = 0; i < 3; ++i) {
    moments.deviations.col(i) =
        std::sqrt(std::max(0.0, eigen.eigenvalues()[2 - i])) * eigen.eigenvectors().col(2 - i);
  }
  return moments;
}

// Points well inside: borders have half a neighbourhood, and may lie where the other surface ends.
std::vector<int> Anchors(const CoarseSurface& surface, const Moments& moments) {
  std::vector<int> anchors;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.0, 0.0),
                                    Eigen::Vector2d(0.8, 0.0),
                                    Eigen::Vector2d(-0.8, 0.0),
                                    Eigen::Vector2d(0.0, 0.8),
                                    Eigen::Vector2d(0.0, -0.8)}) {
    const int anchor =
        surface.tree().Nearest(moments.mean + moments.deviations.leftCols<2>() * at).index;
    if (anchor < 0 || surface.normals()[anchor].isZero()) continue;
    if (std::find(anchors.begin(), anchors.end(), anchor) == anchors.end()) {
      anchors.push_back(anchor);
    }
  }
  return anchors;
}

// A rotation that takes the x axis to `normal`.
Eigen::Matrix3d Frame(const Eigen::Vector3d& normal) {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), normal).toRotationMatrix();
}

// base_from_query, without its scale.
struct Hypothesis {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  double missed = 1.0;
};

struct OrientedPoint {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
};

// The smaller surface, `query`, is laid onto the larger one, `base`; in the unit of the base.
class Searcher {
 public:
  Searcher(const CoarseSurface& query,
           double base_per_query,
           const CoarseSurface& base,
           bool oriented);

  // Every place and turn of every anchor, those that miss least first, no two alike.
  std::vector<Hypothesis> Run(int max_count, const std::function<bool()>& should_stop) const;

 private:
  void TryPlace(const OrientedPoint& anchor,
                const OrientedPoint& place,
                std::vector<Hypothesis>* out) const;
  // The mean of what each sample misses, or at least 1 where the first samples miss too much.
  double Missed(const Hypothesis& hypothesis) const;
  std::vector<Hypothesis> Distinct(std::vector<Hypothesis> hypotheses, int max_count) const;

  const CoarseSurface& base_;
  bool oriented_;
  double diagonal_;
  NearestGrid grid_;
  std::vector<OrientedPoint> samples_;
  std::vector<OrientedPoint> anchors_;
  std::vector<OrientedPoint> places_;
  // Far apart on the query, to tell poses from each other.
  std::vector<Eigen::Vector3d> ends_;
};

std::vector<OrientedPoint> Pick(const CoarseSurface& surface,
                                double scale,
                                const std::vector<int>& indices) {
  std::vector<OrientedPoint> picked;
  picked.reserve(indices.size());
  for (const int index : indices) {
    picked.push_back({scale * surface.points()[index], surface.normals()[index]});
  }
  return picked;
}

Searcher::Searcher(const CoarseSurface& query,
                   double base_per_query,
                   const CoarseSurface& base,
                   bool oriented)
    : base_(base),
      oriented_(oriented),
      diagonal_(base_per_query * Diagonal(query.points())),
      grid_(base.points(), kCell * diagonal_, kReach * diagonal_) {
  FarthestPointOptions spread;
  spread.max_count = kSamples;
  samples_ = Pick(query, base_per_query, FarthestPointSample(query.points(), spread));
  const Moments moments = MomentsOf(query.points());
  anchors_ = Pick(query, base_per_query, Anchors(query, moments));
  for (double spacing = kPlaceSpacing * diagonal_;; spacing *= 1.2) {
    const std::vector<int> places = UniformDownsample(base.points(), spacing);
    if (static_cast<int>(places.size()) > kMaxPlaces) continue;
    places_ = Pick(base, 1.0, places);
    break;
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.5, 1.5}) {
      ends_.push_back(base_per_query * (moments.mean + side * moments.deviations.col(axis)));
    }
  }
}

double Searcher::Missed(const Hypothesis& hypothesis) const {
  constexpr double kTooMuch = 0.75;
  const double per_width = 1.0 / (kWidth * diagonal_);
  const double max_squared = std::pow(kReach / kWidth, 2);
  double sum = 0.0;
  int count = 0;
  for (const OrientedPoint& sample : samples_) {
    const Eigen::Vector3d moved = hypothesis.rotation * sample.point + hypothesis.translation;
    const int hit = grid_.Nearest(moved);
    double share = 1.0;
    if (hit >= 0) {
      const double squared = (per_width * (moved - base_.points()[hit])).squaredNorm();
      double cosine = base_.normals()[hit].dot(hypothesis.rotation * sample.normal);
      if (!oriented_) cosine = std::abs(cosine);
      if (squared < max_squared && cosine > 0.0) {
        // angle^2 up to 60 degrees.
        const double q = squared + 2.0 * (1.0 - cosine) / (kAngleWidth * kAngleWidth);
        share = q / (1.0 + q);
      }
    }
    sum += share;
    if (++count == kFirstSamples && sum > kTooMuch * kFirstSamples) return 1.0;
  }
  return sum / std::max(count, 1);
}

void Searcher::TryPlace(const OrientedPoint& anchor,
                        const OrientedPoint& place,
                        std::vector<Hypothesis>* out) const {
  const Eigen::Matrix3d from = Frame(anchor.normal).transpose();
  const Eigen::Matrix3d to = Frame(place.normal);
  for (int turn = 0; turn < kTurns; ++turn) {
    const double angle = 2.0 * M_PI * turn / kTurns;
    Hypothesis hypothesis;
    hypothesis.rotation = to * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()) * from;
    hypothesis.translation = place.point - hypothesis.rotation * anchor.point;
    hypothesis.missed = Missed(hypothesis);
    if (hypothesis.missed < 1.0) out->push_back(hypothesis);
  }
}

std::vector<Hypothesis> Searcher::Run(int max_count,
                                      const std::function<bool()>& should_stop) const {
  std::vector<Hypothesis> hypotheses;
  for (const OrientedPoint& anchor : anchors_) {
    for (const OrientedPoint& place : places_) {
      if (place.normal.isZero()) continue;
      if (should_stop && should_stop()) return Distinct(std::move(hypotheses), max_count);
      TryPlace(anchor, place, &hypotheses);
      if (!oriented_) TryPlace({anchor.point, -anchor.normal}, place, &hypotheses);
    }
  }
  return Distinct(std::move(hypotheses), max_count);
}

std::vector<Hypothesis> Searcher::Distinct(std::vector<Hypothesis> hypotheses,
                                           int max_count) const {
  std::stable_sort(hypotheses.begin(),
                   hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.missed < b.missed; });
  std::vector<Hypothesis> distinct;
  const double alike = std::pow(kAlike * diagonal_, 2) * static_cast<double>(ends_.size());
  for (const Hypothesis& candidate : hypotheses) {
    const auto same = [&](const Hypothesis& other) {
      double sum = 0.0;
      for (const Eigen::Vector3d& end : ends_) {
        sum += ((candidate.rotation - other.rotation) * end + candidate.translation -
                other.translation)
                   .squaredNorm();
      }
      return sum < alike;
    };
    if (std::any_of(distinct.begin(), distinct.end(), same)) continue;
    distinct.push_back(candidate);
    if (static_cast<int>(distinct.size()) == max_count) break;
  }
  return distinct;
}

}  // namespace

std::vector<Similarity> SearchRigidly(const CoarseSurface& source,
                                      const CoarseSurface& target,
                                      const RigidSearchOptions& options) {
  // Both have one point a cube of equal size, so that fewer points are less area.
  const bool source_is_query = source.size() < target.size();
  const CoarseSurface& query = source_is_query ? source : target;
  const CoarseSurface& base = source_is_query ? target : source;
  const double base_per_query = source_is_query ? options.scale : 1.0 / options.scale;
  std::vector<Similarity> poses;
  if (query.size() == 0) return poses;
  const Searcher searcher(query, base_per_query, base, options.oriented);
  for (const Hypothesis& hypothesis : searcher.Run(options.max_count, options.should_stop)) {
    Similarity base_from_query;
    base_from_query.scale = base_per_query;
    base_from_query.rotation = Eigen::Quaterniond(hypothesis.rotation).normalized();
    base_from_query.translation = hypothesis.translation;
    poses.push_back(source_is_query ? base_from_query : base_from_query.Inverse());
  }
  return poses;
}

}  // namespace ceres_ed
