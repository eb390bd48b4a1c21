#include "ceres_ed/slam/camera_tracker.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Where Tukey's weight ends, in deviations.
constexpr double kTukeyWidth = 4.685;
constexpr double kInlierWidth = 3.0;
// A step smaller than this (map units, and radians times the scene's distance) ends the search.
constexpr double kSmallStep = 1e-4;

double TukeyWeight(double residual, double deviation) {
  const double x = residual / (kTukeyWidth * deviation);
  const double inside = 1.0 - x * x;
  return inside > 0.0 ? inside * inside : 0.0;
}

// x' = x + omega x (x - center) + tau: turning about the scene's middle keeps both parts apart.
CameraPose Moved(const CameraPose& pose, const Vector6d& step, const Eigen::Vector3d& center) {
  const Eigen::Vector3d omega = step.head<3>();
  const double angle = omega.norm();
  const Eigen::Quaterniond turn = angle > 0.0
                                      ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, omega / angle))
                                      : Eigen::Quaterniond::Identity();
  CameraPose moved;
  moved.rotation = (turn * pose.rotation).normalized();
  moved.translation = turn * (pose.translation - center) + center + step.tail<3>();
  return moved;
}

void MoveTo(const CameraPose& pose,
            const PinholeCamera& camera,
            std::vector<VisiblePoint>* points) {
  for (VisiblePoint& point : *points) {
    point.in_camera = pose * point.in_map;
    point.pixel = point.in_camera.z() > 0.0 ? camera.Project(point.in_camera)
                                            : Eigen::Vector2d::Constant(-1e9);
  }
}

// Normal equations of one step, in a frame about `center` with lengths in `radius`.
struct Equations {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();

  void Add(const Vector6d& jacobian, double residual, double weight) {
    hessian += weight * jacobian * jacobian.transpose();
    gradient += weight * residual * jacobian;
  }
};

}  // namespace

CameraTrackerResult TrackCamera(const std::vector<VisiblePoint>& all_points,
                                const std::vector<PointMatch>& matches,
                                const ObservedSurface& surface,
                                const CameraPose& start,
                                const CameraTrackerOptions& options) {
  CameraTrackerResult result;
  result.camera_from_map = start;
  std::vector<VisiblePoint> points;
  const std::size_t stride = std::max<std::size_t>(1, all_points.size() / options.max_points);
  for (std::size_t i = 0; i < all_points.size(); i += stride) points.push_back(all_points[i]);
  if (points.empty()) return result;
  AssociationResult association;
  for (int iteration = 0;; ++iteration) {
    MoveTo(result.camera_from_map, surface.camera(), &points);
    association = Associate(points, result.camera_from_map, surface, options.association);
    const double deviation = std::max(association.deviation, 1e-6);
    result.measured = association.measured;
    result.deviation = association.deviation;
    result.inliers = static_cast<int>(std::count_if(
        association.matches.begin(), association.matches.end(), [&](const Association& m) {
          return std::abs(m.distance) <= kInlierWidth * deviation;
        }));
    result.inlier_ratio = static_cast<double>(result.inliers) / std::max(1, association.measured);
    if (iteration == options.max_iterations || association.matches.size() < 6) return result;

    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const Association& m : association.matches) center += m.patch->point;
    center /= static_cast<double>(association.matches.size());
    double radius = 0.0;
    for (const Association& m : association.matches) {
      radius += (m.patch->point - center).squaredNorm();
    }
    radius = std::sqrt(radius / static_cast<double>(association.matches.size())) + 1e-9;

    Equations equations;
    double total_weight = 0.0;
    for (const Association& m : association.matches) {
      const double weight = m.weight * TukeyWeight(m.distance, deviation);
      Vector6d jacobian;
      jacobian << (points[m.visible].in_camera - center).cross(m.patch->normal) / radius,
          m.patch->normal;
      equations.Add(jacobian, m.distance, weight);
      total_weight += weight;
    }
    std::vector<double> match_distances;
    for (const PointMatch& m : matches) {
      match_distances.push_back((result.camera_from_map * m.in_map - m.in_camera).norm());
    }
    const double match_deviation = std::max(MedianDeviation(match_distances), deviation);
    for (std::size_t k = 0; k < matches.size(); ++k) {
      const double weight = options.match_weight * TukeyWeight(match_distances[k], match_deviation);
      if (weight == 0.0) continue;
      const Eigen::Vector3d x = result.camera_from_map * matches[k].in_map;
      const Eigen::Vector3d residual = x - matches[k].in_camera;
      for (int axis = 0; axis < 3; ++axis) {
        Vector6d jacobian;
        jacobian << (x - center).cross(Eigen::Vector3d::Unit(axis)) / radius,
            Eigen::Vector3d::Unit(axis);
        equations.Add(jacobian, residual[axis], weight);
      }
      total_weight += weight;
    }
    equations.hessian.diagonal().array() += options.prior * total_weight;
    Vector6d step = -equations.hessian.ldlt().solve(equations.gradient);
    if (!step.allFinite()) return result;
    const double size = step.norm();
    step.head<3>() /= radius;
    result.camera_from_map = Moved(result.camera_from_map, step, center);
    if (size < kSmallStep) iteration = options.max_iterations - 1;
  }
}

}  // namespace ceres_ed
