#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/kd_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace ceres_ed {
namespace {

constexpr std::size_t kSamples = 500;
// A mirror image is named if it is this near (a share of the diagonal), and nearer than any turned
// copy by this factor.
constexpr double kNear = 0.02;
constexpr double kClearlyNearer = 0.6;

// Samples of a cloud in the frame of its principal axes, by descending variance.
struct Principal {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> few;
};

Principal InPrincipalAxes(const Specimen& specimen) {
  const std::vector<int>& order = specimen.topology->walk_order;
  constexpr std::size_t kMany = 20000;
  std::vector<Eigen::Vector3d> points;
  const std::size_t step = std::max<std::size_t>(1, order.size() / kMany);
  for (std::size_t i = 0; i < order.size(); i += step) {
    points.push_back(specimen.cloud->points[order[i]]);
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (Eigen::Vector3d& point : points) {
    point -= mean;
    covariance += point * point.transpose();
  }
  Eigen::Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().rowwise().reverse();
  if (axes.determinant() < 0.0) axes.col(2) *= -1.0;
  Principal principal;
  for (Eigen::Vector3d& point : points) point = axes.transpose() * point;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSamples);
  for (std::size_t i = 0; i < points.size(); i += stride) principal.few.push_back(points[i]);
  principal.points = std::move(points);
  return principal;
}

// Returns the mean distance of the samples, with the signs of their axes changed, from a cloud.
double MeanDistance(const std::vector<Eigen::Vector3d>& samples,
                    const Eigen::Vector3d& signs,
                    const KdTree& tree) {
  double sum = 0.0;
  for (const Eigen::Vector3d& sample : samples) {
    sum += std::sqrt(tree.Nearest(sample.cwiseProduct(signs)).squared_distance);
  }
  return sum / static_cast<double>(samples.size());
}

}  // namespace

void CheckMirrored(const Specimen& source, const Specimen& target, std::vector<Finding>* findings) {
  const double diagonal = Diagonal(target.cloud->points);
  if (!(diagonal > 0.0)) return;
  const Principal from = InPrincipalAxes(source);
  const Principal to = InPrincipalAxes(target);
  const KdTree source_tree(from.points);
  const KdTree target_tree(to.points);
  double turned = std::numeric_limits<double>::infinity();
  double mirrored = turned;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d signs(
        (i & 1) != 0 ? -1.0 : 1.0, (i & 2) != 0 ? -1.0 : 1.0, (i & 4) != 0 ? -1.0 : 1.0);
    const double distance = 0.5 * (MeanDistance(from.few, signs, target_tree) +
                                   MeanDistance(to.few, signs, source_tree));
    double& least = signs.prod() > 0.0 ? turned : mirrored;
    least = std::min(least, distance);
  }
  if (!(mirrored < kNear * diagonal) || !(mirrored < kClearlyNearer * turned)) return;
  findings->push_back({"mirrored",
                       Severity::kWarning,
                       target.name + " is nearly a mirror image of " + source.name +
                           ", which no motion makes of it",
                       "check the axes of both files (left-handed against right-handed, left "
                       "against right organ), and mirror one of them",
                       mirrored / turned});
}

}  // namespace ceres_ed
