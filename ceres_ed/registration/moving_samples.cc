#include "ceres_ed/registration/moving_samples.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace ceres_ed {

MovingSamples::MovingSamples(const Surface& source, const BuiltGraph& graph, int count)
    : source_(&source), graph_(&graph), samples_(SamplePoints(source, count)) {
  for (const int point : samples_) {
    points_.push_back(source.cloud().points[point]);
    normals_.push_back(source.cloud().normals[point]);
  }
}

double MovingSamples::Move(const DeformationState& state, int num_threads) {
  const int count = static_cast<int>(samples_.size());
  std::vector<double> motions(samples_.size());
  ParallelFor(num_threads, count, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const int point = samples_[i];
      const Binding binding = graph_->skinning[point];
      const Eigen::Vector3d moved =
          WarpPoint(graph_->graph, state, binding, source_->cloud().points[point]);
      motions[i] = (moved - points_[i]).norm();
      points_[i] = moved;
      normals_[i] = WarpNormal(state, binding, source_->cloud().normals[point]);
    }
  });
  double sum = 0.0;
  for (const double motion : motions) sum += motion;
  return count > 0 ? sum / count : 0.0;
}

double MovingSamples::LostArea(const DeformationState& state) const {
  double lost = 0.0;
  double total = 0.0;
  for (const int point : samples_) {
    const Eigen::Matrix3d A = WarpGradient(state, graph_->skinning[point]);
    // The cofactors of A take area vectors at rest to those of the warped surface.
    Eigen::Matrix3d cofactors;
    cofactors << A.col(1).cross(A.col(2)), A.col(2).cross(A.col(0)), A.col(0).cross(A.col(1));
    const double ratio = (cofactors * source_->cloud().normals[point]).norm();
    const double area = source_->relative_areas()[point];
    lost += area * std::max(0.0, 1.0 - 2.0 * ratio);
    total += area;
  }
  return total > 0.0 ? lost / total : 0.0;
}

double MovingSamples::Stretch(const DeformationState& state, double quantile) const {
  constexpr double kLeastLength = 1e-3;
  std::vector<double> stretches;
  stretches.reserve(samples_.size());
  for (const int point : samples_) {
    const Eigen::Matrix3d A = WarpGradient(state, graph_->skinning[point]);
    const Eigen::Vector3d& normal = source_->cloud().normals[point];
    const Eigen::Vector3d along = normal.unitOrthogonal();
    // The eigenvalues of the metric of the warped tangent plane are the squared singular values.
    const Eigen::Vector3d u = A * along;
    const Eigen::Vector3d v = A * normal.cross(along);
    const double mean = 0.5 * (u.squaredNorm() + v.squaredNorm());
    const double spread = std::hypot(0.5 * (u.squaredNorm() - v.squaredNorm()), u.dot(v));
    const auto change = [&](double squared) {
      const double length = std::sqrt(std::max(squared, 0.0));
      return std::abs(std::log(std::clamp(length, kLeastLength, 1.0 / kLeastLength)));
    };
    stretches.push_back(std::max(change(mean - spread), change(mean + spread)));
  }
  if (stretches.empty()) return 0.0;
  const auto place = static_cast<std::ptrdiff_t>(quantile * (stretches.size() - 1.0));
  std::nth_element(stretches.begin(), stretches.begin() + place, stretches.end());
  return stretches[static_cast<std::size_t>(place)];
}

}  // namespace ceres_ed
