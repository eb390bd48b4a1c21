#include "ceres_ed/graph/vertex_field.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kNeighbors = 4;
// The distances between which the field fades out, in spacings of the field.
constexpr double kWholeUpTo = 2.0;
constexpr double kGoneFrom = 6.0;

// Returns 1 up to kWholeUpTo and 0 from kGoneFrom, with a smooth transition between them.
double Fade(double distance, double spacing) {
  if (distance <= kWholeUpTo * spacing) return 1.0;
  if (distance >= kGoneFrom * spacing) return 0.0;
  const double t = (kGoneFrom - distance / spacing) / (kGoneFrom - kWholeUpTo);
  return t * t * (3.0 - 2.0 * t);
}

// The field with one point for each position, and a search tree over these points.
class FieldSearch {
 public:
  explicit FieldSearch(const VertexField& field)
      : order_(Positions(field)), points_(Pick(field.points)), tree_(points_) {
    displacements_ = Pick(field.displacements);
  }

  Eigen::Vector3d At(const Eigen::Vector3d& query) const {
    Neighbor nearest[kNeighbors];
    const int count = tree_.KNearest(query, kNeighbors, nearest);
    if (count == 0) return Eigen::Vector3d::Zero();
    if (nearest[0].squared_distance == 0.0) return displacements_[nearest[0].index];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (int i = 0; i < count; ++i) {
      // Weights are relative to that of the nearest point, so that no division by a tiny distance
      // occurs.
      const double weight = nearest[0].squared_distance / nearest[i].squared_distance;
      sum += weight * displacements_[nearest[i].index];
      weights += weight;
    }
    const double distance = std::sqrt(nearest[0].squared_distance);
    return Fade(distance, Spacing(nearest[0].index)) / weights * sum;
  }

 private:
  static std::vector<int> Positions(const VertexField& field) {
    std::vector<int> order;
    WeldPoints(field.points, &order);
    return order;
  }

  std::vector<Eigen::Vector3d> Pick(const std::vector<Eigen::Vector3d>& values) const {
    std::vector<Eigen::Vector3d> picked;
    picked.reserve(order_.size());
    for (const int index : order_) picked.push_back(values[index]);
    return picked;
  }

  // Returns the mean distance of a field point from its nearest neighbours.
  double Spacing(int index) const {
    Neighbor around[kNeighbors + 1];
    const int count = tree_.KNearest(points_[index], kNeighbors + 1, around);
    double sum = 0.0;
    for (int i = 1; i < count; ++i) sum += std::sqrt(around[i].squared_distance);
    return sum / std::max(1, count - 1);
  }

  std::vector<int> order_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> displacements_;
  KdTree tree_;
};

}  // namespace

std::vector<Eigen::Vector3d> EvaluateField(const VertexField& field,
                                           const std::vector<Eigen::Vector3d>& queries,
                                           int num_threads) {
  CHECK_EQ(field.points.size(), field.displacements.size());
  if (queries == field.points) return field.displacements;
  std::vector<Eigen::Vector3d> values(queries.size(), Eigen::Vector3d::Zero());
  if (field.empty()) return values;
  const FieldSearch search(field);
  ParallelFor(num_threads, static_cast<int>(queries.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) values[i] = search.At(queries[i]);
  });
  return values;
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
