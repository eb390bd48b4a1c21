#include "ceres_ed/graph/vertex_field.h"

#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kNeighbors = 4;
// The distances between which the field fades out, in spacings of the field.
constexpr double kWholeUpTo = 2.0;
constexpr double kGoneFrom = 6.0;

// Returns 1 up to kWholeUpTo and 0 from kGoneFrom, with a smooth transition between them. Writes
// the derivative by the distance to `slope`.
double Fade(double distance, double spacing, double* slope) {
  *slope = 0.0;
  if (distance <= kWholeUpTo * spacing) return 1.0;
  if (distance >= kGoneFrom * spacing) return 0.0;
  const double t = (kGoneFrom - distance / spacing) / (kGoneFrom - kWholeUpTo);
  *slope = -6.0 * t * (1.0 - t) / (spacing * (kGoneFrom - kWholeUpTo));
  return t * t * (3.0 - 2.0 * t);
}

// Returns the indices of points with positions of their own.
std::vector<int> PositionsOf(const VertexField& field) {
  std::vector<int> order;
  WeldPoints(field.points, &order);
  return order;
}

// The mean over the nearest points, weighted by 1 / d^2.
struct WeightedMean {
  std::array<Neighbor, kNeighbors> nearest;
  // Relative to that of the nearest point, so that no division by a tiny distance occurs.
  std::array<double, kNeighbors> weights;
  int count = 0;
  double sum_of_weights = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
};

// Returns the derivative of sum / sum_of_weights by the query. With w = 1 / d^2 it is
//   sum_i w_i (f_i - f) grad(log w_i)^T / sum_i w_i,   grad(log w_i) = -2 (query - p_i) / d_i^2.
Eigen::Matrix3d GradientOf(const WeightedMean& mean,
                           const Eigen::Vector3d& query,
                           const std::vector<Eigen::Vector3d>& points,
                           const std::vector<Eigen::Vector3d>& values) {
  const Eigen::Vector3d f = mean.sum / mean.sum_of_weights;
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  for (int i = 0; i < mean.count; ++i) {
    const Neighbor& near = mean.nearest[i];
    const double factor = -2.0 * mean.weights[i] / (mean.sum_of_weights * near.squared_distance);
    gradient += factor * (values[near.index] - f) * (query - points[near.index]).transpose();
  }
  return gradient;
}

}  // namespace

std::vector<Eigen::Vector3d> EvaluateField(const VertexField& field,
                                           const std::vector<Eigen::Vector3d>& queries,
                                           int num_threads) {
  CHECK_EQ(field.points.size(), field.displacements.size());
  if (queries == field.points) return field.displacements;
  std::vector<Eigen::Vector3d> values(queries.size(), Eigen::Vector3d::Zero());
  if (field.empty()) return values;
  const VertexFieldSampler sampler(field, queries.size(), num_threads);
  ParallelFor(num_threads, static_cast<int>(queries.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) values[i] = sampler.At(queries[i]);
  });
  return values;
}

VertexFieldSampler::VertexFieldSampler(const VertexField& field,
                                       std::size_t expected_queries,
                                       int num_threads)
    : order_(PositionsOf(field)),
      points_(Pick(field.points)),
      displacements_(Pick(field.displacements)),
      tree_(points_) {
  if (expected_queries <= points_.size()) return;
  spacings_.resize(points_.size());
  ParallelFor(num_threads, static_cast<int>(points_.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) spacings_[i] = SpacingAround(i);
  });
}

Eigen::Vector3d VertexFieldSampler::At(const Eigen::Vector3d& query,
                                       Eigen::Matrix3d* gradient) const {
  if (gradient != nullptr) gradient->setZero();
  WeightedMean mean;
  mean.count = tree_.KNearest(query, kNeighbors, mean.nearest.data());
  if (mean.count == 0) return Eigen::Vector3d::Zero();
  const Neighbor& first = mean.nearest[0];
  if (first.squared_distance == 0.0) return displacements_[first.index];
  for (int i = 0; i < mean.count; ++i) {
    mean.weights[i] = first.squared_distance / mean.nearest[i].squared_distance;
    mean.sum += mean.weights[i] * displacements_[mean.nearest[i].index];
    mean.sum_of_weights += mean.weights[i];
  }
  const double distance = std::sqrt(first.squared_distance);
  double slope = 0.0;
  const double spacing = spacings_.empty() ? SpacingAround(first.index) : spacings_[first.index];
  const double fade = Fade(distance, spacing, &slope);
  if (gradient != nullptr) {
    *gradient = fade * GradientOf(mean, query, points_, displacements_) +
                slope / (mean.sum_of_weights * distance) * mean.sum *
                    (query - points_[first.index]).transpose();
  }
  return fade / mean.sum_of_weights * mean.sum;
}

std::vector<Eigen::Vector3d> VertexFieldSampler::Pick(
    const std::vector<Eigen::Vector3d>& values) const {
  std::vector<Eigen::Vector3d> picked;
  picked.reserve(order_.size());
  for (const int index : order_) picked.push_back(values[index]);
  return picked;
}

double VertexFieldSampler::SpacingAround(int index) const {
  Neighbor around[kNeighbors + 1];
  const int count = tree_.KNearest(points_[index], kNeighbors + 1, around);
  double sum = 0.0;
  for (int i = 1; i < count; ++i) sum += std::sqrt(around[i].squared_distance);
  return sum / std::max(1, count - 1);
}

void TurnNormals(const std::vector<Eigen::Vector3d>& before,
                 const std::vector<Eigen::Vector3d>& after,
                 std::vector<Eigen::Vector3d>* normals) {
  CHECK_EQ(before.size(), normals->size());
  CHECK_EQ(after.size(), normals->size());
  for (std::size_t p = 0; p < normals->size(); ++p) {
    if (before[p].isZero(0.0) || after[p].isZero(0.0)) continue;
    (*normals)[p] = Eigen::Quaterniond::FromTwoVectors(before[p], after[p]) * (*normals)[p];
  }
}

}  // namespace ceres_ed
