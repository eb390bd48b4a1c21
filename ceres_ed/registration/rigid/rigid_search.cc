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
// This many samples decide whether the remaining samples are evaluated.
constexpr int kFirstSamples = 16;
// Lengths as fractions of the smaller surface's diagonal: the spacing of the places that are tried;
// the distance at which a point counts half as unmatched; the edge of a grid cell; the distance
// beyond which a point is unmatched.
constexpr double kPlaceSpacing = 0.06;
constexpr double kWidth = 0.05;
constexpr double kCell = 0.035;
constexpr double kReach = 0.12;
// If there are more places than this, their spacing is increased.
constexpr int kMaxPlaces = 800;
constexpr double kAngleWidth = 30.0 * M_PI / 180.0;
// Two poses are alike if the ends of the smaller surface differ by less than this (a fraction of
// its diagonal, root mean square).
constexpr double kAlike = 0.08;

struct Moments {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  // The principal directions as columns, by descending variance; their lengths are the standard
  // deviations.
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

// Returns anchors in the interior. At a border, half of the neighbourhood is missing, and the other
// surface may end there.
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

// Returns a rotation that maps the x axis to `normal`.
Eigen::Matrix3d Frame(const Eigen::Vector3d& normal) {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), normal).toRotationMatrix();
}

// A pose base_from_query without its scale.
struct Hypothesis {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  double unmatched = 1.0;
};

struct OrientedPoint {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
};

// Lays the smaller surface (`query`) onto the larger one (`base`). Lengths are in the unit of the
// base.
class Searcher {
 public:
  Searcher(const CoarseSurface& query,
           double base_per_query,
           const CoarseSurface& base,
           bool oriented,
           bool reversed);

  // Returns the best poses over every place and rotation of every anchor, without similar ones.
  std::vector<Hypothesis> Run(int max_count, const std::function<bool()>& should_stop) const;

 private:
  void TryPlace(const OrientedPoint& anchor,
                const OrientedPoint& place,
                std::vector<Hypothesis>* out) const;
  // Returns the mean of the samples' unmatched shares, or at least 1 if the first samples miss too
  // much.
  double UnmatchedShare(const Hypothesis& hypothesis) const;
  std::vector<Hypothesis> Distinct(std::vector<Hypothesis> hypotheses, int max_count) const;

  const CoarseSurface& base_;
  bool oriented_;
  double diagonal_;
  NearestGrid grid_;
  std::vector<OrientedPoint> samples_;
  std::vector<OrientedPoint> anchors_;
  std::vector<OrientedPoint> places_;
  // Points far apart on the query, by which poses are compared.
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
                   bool oriented,
                   bool reversed)
    : base_(base),
      oriented_(oriented),
      diagonal_(base_per_query * Diagonal(query.points())),
      grid_(base.points(), kCell * diagonal_, kReach * diagonal_) {
  FarthestPointOptions spread;
  spread.max_count = kSamples;
  samples_ = Pick(query, base_per_query, FarthestPointSample(query.points(), spread));
  const Moments moments = MomentsOf(query.points());
  anchors_ = Pick(query, base_per_query, Anchors(query, moments));
  if (reversed) {
    // Only the side of one surface relative to that of the other matters.
    for (OrientedPoint& sample : samples_) sample.normal = -sample.normal;
    for (OrientedPoint& anchor : anchors_) anchor.normal = -anchor.normal;
  }
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

double Searcher::UnmatchedShare(const Hypothesis& hypothesis) const {
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
        // Approximates angle^2 for angles up to 60 degrees.
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
    hypothesis.unmatched = UnmatchedShare(hypothesis);
    if (hypothesis.unmatched < 1.0) out->push_back(hypothesis);
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
  std::stable_sort(
      hypotheses.begin(), hypotheses.end(), [](const Hypothesis& a, const Hypothesis& b) {
        return a.unmatched < b.unmatched;
      });
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
  // Both surfaces have one point per cube of equal size, so fewer points mean less area.
  const bool source_is_query = source.size() < target.size();
  const CoarseSurface& query = source_is_query ? source : target;
  const CoarseSurface& base = source_is_query ? target : source;
  const double base_per_query = source_is_query ? options.scale : 1.0 / options.scale;
  std::vector<Similarity> poses;
  // A surface whose points are all at one place lies anywhere.
  if (!(Diagonal(query.points()) > 0.0) || !(Diagonal(base.points()) > 0.0)) return poses;
  const Searcher searcher(query, base_per_query, base, options.oriented, options.reversed);
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
