#include "ceres_ed/slam/frame/camera_tracker.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// The residual at which Tukey's weight becomes zero, in deviations.
constexpr double kTukeyWidth = 4.685;
constexpr double kInlierWidth = 3.0;
constexpr double kLeastDeviation = 1e-6;
constexpr std::size_t kFewestMatches = 6;
// A step smaller than this ends the search, in map units.
constexpr double kSmallStep = 1e-4;

double TukeyWeight(double residual, double deviation) {
  const double x = residual / (kTukeyWidth * deviation);
  const double inside = 1.0 - x * x;
  return inside > 0.0 ? inside * inside : 0.0;
}

// Returns the pose that maps to x' = x + omega x (x - center) + tau.
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

// The normal equations of one step. Rotations are about the centre of the scene and in units of its
// radius, so that all six unknowns are lengths.
class StepEquations {
 public:
  explicit StepEquations(const std::vector<Association>& matches) {
    for (const Association& m : matches) center_ += m.patch->point;
    center_ /= static_cast<double>(matches.size());
    for (const Association& m : matches) radius_ += (m.patch->point - center_).squaredNorm();
    radius_ = std::sqrt(radius_ / static_cast<double>(matches.size())) + 1e-9;
  }

  // Adds the distance of `point` along a direction.
  void Add(const Eigen::Vector3d& point,
           const Eigen::Vector3d& direction,
           double residual,
           double weight) {
    Vector6d jacobian;
    jacobian << (point - center_).cross(direction) / radius_, direction;
    hessian_ += weight * jacobian * jacobian.transpose();
    gradient_ += weight * residual * jacobian;
    weight_ += weight;
  }

  // Moves `pose` by the step and returns the size of the step in map units; negative if there is
  // none.
  double Solve(double damping, CameraPose* pose) const {
    Matrix6d damped = hessian_;
    damped.diagonal().array() += damping * weight_;
    Vector6d step = -damped.ldlt().solve(gradient_);
    if (!step.allFinite()) return -1.0;
    const double size = step.norm();
    step.head<3>() /= radius_;
    *pose = Moved(*pose, step, center_);
    return size;
  }

 private:
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double weight_ = 0.0;
  Matrix6d hessian_ = Matrix6d::Zero();
  Vector6d gradient_ = Vector6d::Zero();
};

// Returns every n-th point, so that about `max_points` are left.
std::vector<VisiblePoint> Thinned(const std::vector<VisiblePoint>& all, int max_points) {
  std::vector<VisiblePoint> points;
  const std::size_t stride = std::max<std::size_t>(1, all.size() / max_points);
  for (std::size_t i = 0; i < all.size(); i += stride) points.push_back(all[i]);
  return points;
}

void AddPointMatches(const std::vector<PointMatch>& matches,
                     const CameraPose& pose,
                     double least_deviation,
                     double weight,
                     StepEquations* equations) {
  std::vector<double> distances;
  distances.reserve(matches.size());
  for (const PointMatch& m : matches) {
    distances.push_back((pose * m.in_map - m.in_camera).norm());
  }
  const double deviation = std::max(RobustDeviation(distances), least_deviation);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    const double robust = weight * TukeyWeight(distances[k], deviation);
    if (robust == 0.0) continue;
    const Eigen::Vector3d x = pose * matches[k].in_map;
    const Eigen::Vector3d residual = x - matches[k].in_camera;
    for (int axis = 0; axis < 3; ++axis) {
      equations->Add(x, Eigen::Vector3d::Unit(axis), residual[axis], robust);
    }
  }
}

}  // namespace

CameraTrackerResult TrackCamera(const std::vector<VisiblePoint>& all_points,
                                const std::vector<PointMatch>& matches,
                                const ObservedSurface& surface,
                                const CameraPose& start,
                                const CameraTrackerOptions& options) {
  CameraTrackerResult result;
  result.camera_from_map = start;
  std::vector<VisiblePoint> points = Thinned(all_points, options.max_points);
  if (points.empty()) return result;
  // Each iteration associates the points again and takes one Gauss-Newton step.
  for (int iteration = 0;; ++iteration) {
    CameraPose& pose = result.camera_from_map;
    MoveTo(pose, surface.camera(), &points);
    const AssociationResult association = Associate(points, pose, surface, options.association);
    const double deviation = std::max(association.deviation, kLeastDeviation);
    const auto is_inlier = [&](const Association& m) {
      return std::abs(m.distance) <= kInlierWidth * deviation;
    };
    result.measured = association.measured;
    result.deviation = association.deviation;
    result.inliers = static_cast<int>(
        std::count_if(association.matches.begin(), association.matches.end(), is_inlier));
    if (iteration >= options.max_iterations || association.matches.size() < kFewestMatches) {
      return result;
    }
    StepEquations equations(association.matches);
    for (const Association& m : association.matches) {
      equations.Add(points[m.visible].in_camera,
                    m.patch->normal,
                    m.distance,
                    m.weight * TukeyWeight(m.distance, deviation));
    }
    AddPointMatches(matches, pose, deviation, options.match_weight, &equations);
    const double step = equations.Solve(options.damping, &pose);
    if (step < 0.0) return result;
    // After a small step the points are associated once more.
    if (step < kSmallStep) iteration = options.max_iterations - 1;
  }
}

}  // namespace ceres_ed
