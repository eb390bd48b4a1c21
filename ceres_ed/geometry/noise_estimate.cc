#include "ceres_ed/geometry/noise_estimate.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kCoefficients = 6;
// The factor by which the variance that a quadric leaves on a smooth surface grows when the number
// of points is doubled. A term of third order grows with the cube of the radius, and its square
// grows with the cube of the number of points.
constexpr double kShapeGrowth = 8.0;

using Basis = Eigen::Matrix<double, kCoefficients, 1>;

// If the noise is smaller than this fraction of the width of a patch, the plane of the patch is
// known well enough.
constexpr double kNarrowNoise = 0.15;

struct PatchFit {
  // The variance of the residual per degree of freedom.
  double variance = 0.0;
  // The standard deviation of the points along the longest axis of the patch.
  double spread = 0.0;
};

// Fits a quadric to the first `count` of `neighbors`, as a height over the plane of least spread.
PatchFit FitQuadric(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<int>& neighbors,
                    int count) {
  // The axes of the patch: the eigenvectors of its scatter matrix. The first one is its normal.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) mean += points[neighbors[i]];
  mean /= count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d offset = points[neighbors[i]] - mean;
    scatter += offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
  // Coordinates are divided by the spread, so that all powers in the basis have a similar size.
  const double scale = std::sqrt(axes.eigenvalues()[2] / count);
  if (!(scale > 0.0)) return {};

  // Least squares by the normal equations.
  using Normal = Eigen::Matrix<double, kCoefficients, kCoefficients>;
  Normal lhs = Normal::Zero();
  Basis rhs = Basis::Zero();
  double sum_squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d local =
        axes.eigenvectors().transpose() * (points[neighbors[i]] - mean) / scale;
    const double u = local[2];
    const double v = local[1];
    Basis basis;
    basis << 1.0, u, v, u * u, u * v, v * v;
    lhs += basis * basis.transpose();
    rhs += basis * local[0];
    sum_squares += local[0] * local[0];
  }
  const Basis fitted = lhs.ldlt().solve(rhs);
  const double left = sum_squares - fitted.dot(rhs);
  return {std::max(0.0, left) * scale * scale / (count - kCoefficients), scale};
}

// Returns the median of a chi-square variable per degree of freedom (Wilson and Hilferty).
double ChiSquareMedian(int freedom) { return std::pow(1.0 - 2.0 / (9.0 * freedom), 3); }

// Finds neighbours over the edges of a mesh, or in space.
class Neighborhood {
 public:
  Neighborhood(const std::vector<Eigen::Vector3d>& points, const SurfaceTopology& topology)
      : topology_(topology), mark_(points.size(), -1) {
    if (topology.HasSurface()) return;
    for (const int point : topology.walk_order) positions_.push_back(points[point]);
    tree_ = std::make_unique<KdTree>(positions_);
  }

  // Returns the first `count` points around the point of rank `rank` in walk_order, which is the
  // first of them.
  const std::vector<int>& Around(int rank, int count) {
    found_.clear();
    if (tree_ != nullptr) {
      tree_->KNearest(positions_[rank], count, &nearest_);
      for (const Neighbor& n : nearest_) found_.push_back(topology_.walk_order[n.index]);
      return found_;
    }
    // Neighbours are collected ring by ring. The nearest neighbours in space would be those with
    // the least noise.
    const int start = topology_.walk_order[rank];
    found_.push_back(start);
    mark_[start] = ++round_;
    for (std::size_t i = 0; i < found_.size() && static_cast<int>(found_.size()) < count; ++i) {
      for (const SurfaceLink& link : topology_.Edges(found_[i])) {
        if (mark_[link.to] == round_) continue;
        mark_[link.to] = round_;
        found_.push_back(link.to);
      }
    }
    return found_;
  }

 private:
  const SurfaceTopology& topology_;
  std::vector<Eigen::Vector3d> positions_;
  std::unique_ptr<KdTree> tree_;
  std::vector<int> mark_;
  int round_ = -1;
  std::vector<Neighbor> nearest_;
  std::vector<int> found_;
};

struct Estimate {
  double noise = 0.0;
  // The median spread of the larger patches.
  double spread = 0.0;
};

// Estimates the noise from patches of `small` points and of twice as many.
Estimate EstimateWith(const std::vector<Eigen::Vector3d>& points,
                      const SurfaceTopology& topology,
                      int samples,
                      int small) {
  const int large = 2 * small;
  const long available = static_cast<long>(topology.walk_order.size());
  const long count = std::min<long>(available, samples);
  Neighborhood neighborhood(points, topology);
  std::vector<double> small_variances;
  std::vector<double> large_variances;
  std::vector<double> spreads;
  for (long i = 0; i < count; ++i) {
    const int rank = static_cast<int>(i * available / count);
    const std::vector<int>& around = neighborhood.Around(rank, large);
    if (static_cast<int>(around.size()) < large) continue;
    small_variances.push_back(FitQuadric(points, around, small).variance);
    const PatchFit fit = FitQuadric(points, around, large);
    large_variances.push_back(fit.variance);
    spreads.push_back(fit.spread);
  }
  if (spreads.empty()) return {};
  // The variances are v_small = noise + shape and v_large = noise + kShapeGrowth * shape.
  const double v_small =
      Median(std::move(small_variances)) / ChiSquareMedian(small - kCoefficients);
  const double v_large =
      Median(std::move(large_variances)) / ChiSquareMedian(large - kCoefficients);
  const double variance = (kShapeGrowth * v_small - v_large) / (kShapeGrowth - 1.0);
  return {std::sqrt(std::max(0.0, variance)), Median(std::move(spreads))};
}

}  // namespace

double EstimateNoise(const std::vector<Eigen::Vector3d>& points,
                     const SurfaceTopology& topology,
                     const NoiseOptions& options) {
  CHECK_GE(options.samples, 1);
  CHECK_GE(options.neighbors, 8);
  CHECK_EQ(points.size(), topology.representative.size());
  double noise = 0.0;
  int neighbors = options.neighbors;
  for (int doubling = 0; doubling <= options.max_doublings; ++doubling, neighbors *= 2) {
    const Estimate estimate = EstimateWith(points, topology, options.samples, neighbors);
    // Stop if no patch has that many points.
    if (!(estimate.spread > 0.0)) break;
    noise = estimate.noise;
    if (noise < kNarrowNoise * estimate.spread) break;
  }
  return noise;
}

}  // namespace ceres_ed
