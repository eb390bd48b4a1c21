#include "ceres_ed/slam/frame/camera_tracker.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace ceres_ed {
namespace {

// The residual at which Tukey's weight becomes zero, in deviations.
constexpr double kTukeyWidth = 4.685;
constexpr double kInlierWidth = 3.0;
constexpr double kLeastDeviation = 1e-6;
constexpr std::size_t kFewestMatches = 6;
// The part of the strength from noise that is not known.
constexpr double kUncertainNoise = 0.1;
// A step smaller than this ends the search, in map units.
constexpr double kSmallStep = 1e-4;

double TukeyWeight(double residual, double width) {
  const double x = residual / width;
  const double inside = 1.0 - x * x;
  return inside > 0.0 ? inside * inside : 0.0;
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

// The normal equations of one step, in the coordinates of MotionInformation.
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

  // What is added from now on is not a plane with a noisy normal.
  void EndPlanes() { plane_weight_ = weight_; }

  // Returns false if no match has a weight.
  bool Analyse(double slope_noise, double floor, MotionInformation* information) const {
    if (!(weight_ > 0.0)) return false;
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(hessian_ / weight_);
    information->center = center_;
    information->radius = radius_;
    information->strengths = eigen.eigenvalues().cwiseMax(0.0);
    information->directions = eigen.eigenvectors();
    const double noise = slope_noise * slope_noise;
    information->noise = noise * plane_weight_ / weight_;
    information->floor = floor + kUncertainNoise * noise;
    return true;
  }

  // Moves `pose` by a step, and returns its size. The unknown is the motion x since `start`. With
  // the strength s_i, the gradient g_i and the share D_i to which direction i is determined, a
  // prior of weight s_i (1 - D_i) / D_i holds x_i at 0, so that the share D_i of the motion that
  // the data ask for is left:
  //   dx_i = -(D_i g_i / s_i + (1 - D_i) x_i)
  double Solve(const MotionInformation& information,
               const CameraPose& start,
               CameraPose* pose) const {
    const Matrix6d& directions = information.directions;
    const Vector6d gradient = directions.transpose() * gradient_ / weight_;
    const Vector6d moved =
        directions.transpose() * information.CoordinatesOf(*pose * start.Inverse());
    Vector6d step;
    for (int i = 0; i < 6; ++i) {
      const double determined = information.Determined(i);
      const double asked = determined > 0.0 ? gradient[i] / information.strengths[i] : 0.0;
      step[i] = -(determined * asked + (1.0 - determined) * moved[i]);
    }
    if (!step.allFinite()) return 0.0;
    *pose = information.MotionOf(directions * step) * *pose;
    return step.norm();
  }

 private:
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double weight_ = 0.0;
  double plane_weight_ = 0.0;
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
                     double least_width,
                     double weight,
                     StepEquations* equations) {
  std::vector<double> distances;
  distances.reserve(matches.size());
  for (const PointMatch& m : matches) {
    distances.push_back((pose * m.in_map - m.in_camera).norm());
  }
  const double width = std::max(kTukeyWidth * RobustDeviation(distances), least_width);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    const double robust = weight * matches[k].weight * TukeyWeight(distances[k], width);
    if (robust == 0.0) continue;
    const Eigen::Vector3d x = pose * matches[k].in_map;
    const Eigen::Vector3d residual = x - matches[k].in_camera;
    for (int axis = 0; axis < 3; ++axis) {
      equations->Add(x, Eigen::Vector3d::Unit(axis), residual[axis], robust);
    }
  }
}

}  // namespace

double Misfit(const std::vector<VisiblePoint>& points,
              const CameraPose& camera_from_map,
              const ObservedSurface& surface) {
  constexpr int kSamples = 1000;
  std::vector<VisiblePoint> samples = Thinned(points, kSamples);
  MoveTo(camera_from_map, surface.camera(), &samples);
  const AssociationResult result =
      Associate(samples, camera_from_map, surface, AssociationOptions());
  if (result.measured == 0) return 1.0;
  // A point without a match is as far away as a match can be.
  double sum = result.measured - static_cast<double>(result.matches.size());
  for (const Association& m : result.matches) sum += m.distance * m.distance;
  return sum / result.measured;
}

CameraTrackerResult TrackCamera(const std::vector<VisiblePoint>& all_points,
                                const std::vector<PointMatch>& matches,
                                const ObservedSurface& surface,
                                const CameraPose& start,
                                const CameraTrackerOptions& options) {
  CameraTrackerResult result;
  result.camera_from_map = start;
  std::vector<VisiblePoint> points = Thinned(all_points, options.max_points);
  if (points.empty()) return result;
  double least_width = options.first_width;
  // Each iteration associates the points again and takes one Gauss-Newton step.
  for (int iteration = 0;; ++iteration) {
    CameraPose& pose = result.camera_from_map;
    MoveTo(pose, surface.camera(), &points);
    const AssociationResult association = Associate(points, pose, surface, options.association);
    const double deviation = std::max(association.deviation, kLeastDeviation);
    const auto is_inlier = [&](const Association& m) {
      return std::abs(m.ScaledDistance()) <= kInlierWidth * deviation;
    };
    result.measured = association.measured;
    result.deviation = association.deviation;
    result.inliers = static_cast<int>(
        std::count_if(association.matches.begin(), association.matches.end(), is_inlier));
    if (association.matches.size() < kFewestMatches) return result;
    const double width = std::max(kTukeyWidth * deviation, least_width);
    StepEquations equations(association.matches);
    for (const Association& m : association.matches) {
      equations.Add(points[m.visible].in_camera,
                    m.patch->normal,
                    m.distance,
                    m.weight * TukeyWeight(m.ScaledDistance(), width));
    }
    equations.EndPlanes();
    AddPointMatches(matches, pose, width, options.match_weight, &equations);
    if (!equations.Analyse(surface.slope_noise(), options.strength_floor, &result.information)) {
      return result;
    }
    if (iteration >= options.max_iterations) return result;
    const double step = equations.Solve(result.information, start, &pose);
    const bool narrow = least_width <= options.least_width;
    least_width = std::max(0.5 * least_width, options.least_width);
    // After a small step the points are associated once more.
    if (narrow && step < kSmallStep) iteration = options.max_iterations - 1;
  }
}

}  // namespace ceres_ed
