#include "ceres_ed/registration/intrinsic/laplacian.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// The cotangent of an angle is limited to this size: about 6 degrees.
constexpr double kMaxCotangent = 10.0;
// The smallest weight of an edge, and the smallest mass as a share of the mean.
constexpr double kLeastWeight = 1e-3;
constexpr double kLeastMass = 0.02;

using Triplets = std::vector<Eigen::Triplet<double>>;

}  // namespace

Laplacian BuildLaplacian(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<std::array<int, 3>>& triangles,
                         double triangle_weight) {
  const int n = static_cast<int>(points.size());
  Laplacian laplacian;
  laplacian.mass = Eigen::VectorXd::Zero(n);
  Triplets edges;
  for (const std::array<int, 3>& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const int b = t[(k + 1) % 3];
      const int c = t[(k + 2) % 3];
      const Eigen::Vector3d to_b = points[b] - points[t[k]];
      const Eigen::Vector3d to_c = points[c] - points[t[k]];
      const double twice_area = to_b.cross(to_c).norm();
      laplacian.mass[t[k]] += triangle_weight * twice_area / 6.0;
      const double dot = to_b.dot(to_c);
      const double cotangent = twice_area * kMaxCotangent > std::abs(dot)
                                   ? dot / twice_area
                                   : (dot > 0.0 ? kMaxCotangent : -kMaxCotangent);
      edges.emplace_back(std::max(b, c), std::min(b, c), 0.5 * triangle_weight * cotangent);
    }
  }
  Eigen::SparseMatrix<double> weights(n, n);
  weights.setFromTriplets(edges.begin(), edges.end());
  Triplets entries;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
  for (int column = 0; column < n; ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(weights, column); entry; ++entry) {
      const double weight = std::max(entry.value(), kLeastWeight);
      const int row = static_cast<int>(entry.row());
      entries.emplace_back(row, column, -weight);
      diagonal[row] += weight;
      diagonal[column] += weight;
    }
  }
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[i]);
  laplacian.stiffness.resize(n, n);
  laplacian.stiffness.setFromTriplets(entries.begin(), entries.end());
  laplacian.stiffness.makeCompressed();
  laplacian.mass = laplacian.mass.cwiseMax(kLeastMass * laplacian.mass.mean());
  return laplacian;
}

}  // namespace ceres_ed
