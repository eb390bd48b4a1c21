#include "ceres_ed/registration/fit_validation.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace ceres_ed {
namespace {

// Source and target whose diagonals differ by more than this share no scale: millimetres against
// metres is 1000, a partial view of a body seldom less than a tenth of it.
constexpr double kMaxScaleRatio = 25.0;
constexpr int kMinPoints = 4;
constexpr int kMaxLevels = 5;

Status CheckIndex(const char* what, int point, std::size_t size) {
  if (point >= 0 && point < static_cast<int>(size)) return Status::Ok();
  return Status::Error(std::string(what) + " names source point " + std::to_string(point) +
                       ", the source has " + std::to_string(size));
}

Status CheckPoints(const FitInput& input) {
  if (input.target.empty() && input.landmarks.empty()) {
    return Status::Error("a fit needs a target or landmarks");
  }
  if (!input.target.empty() && input.target.size() < kMinPoints) {
    return Status::Error("the target has " + std::to_string(input.target.size()) +
                         " points, a fit needs at least " + std::to_string(kMinPoints));
  }
  for (const PointConstraint& landmark : input.landmarks) {
    Status status = CheckIndex("a landmark", landmark.point, input.source.size());
    if (!status.ok()) return status;
  }
  for (const int point : input.fixed_points) {
    Status status = CheckIndex("the list of fixed points", point, input.source.size());
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

Status CheckScale(const FitInput& input, const FitOptions& options) {
  const double source = Diagonal(input.source.points);
  if (input.target.empty()) return Status::Ok();
  const double target = Diagonal(input.target.points);
  if (!(target > 0.0)) return Status::Error("the target has no extent: all its points coincide");
  const double ratio = std::max(source / target, target / source);
  if (ratio <= kMaxScaleRatio || options.rigid.with_scale) return Status::Ok();
  std::ostringstream message;
  message << "source and target share no scale: their diagonals are " << source << " and " << target
          << " (at most a factor of " << kMaxScaleRatio << " is expected; are the units the same?)";
  return Status::Error(message.str());
}

}  // namespace

bool FitOptions::IsValid(std::string* error) const {
  if (!strategy.IsValid(error) || !graph.IsValid(error) || !matching.IsValid(error) ||
      !rigid.IsValid(error) || !finish_options.IsValid(error)) {
    return false;
  }
  std::ostringstream message;
  const auto bad = [&](const char* name, double value, const char* expected) {
    message << name << " is " << value << ", expected " << expected;
  };
  const double all_weights[] = {
      weights.rotation, weights.regularization, weights.data, weights.landmark, weights.fixed};
  for (const double weight : all_weights) {
    if (!(std::isfinite(weight) && weight >= 0.0)) {
      bad("a weight", weight, "finite and >= 0");
      break;
    }
  }
  if (!message.str().empty()) {
  } else if (!(weights.point_to_point_share >= 0.0 && weights.point_to_point_share <= 1.0)) {
    bad("point_to_point_share", weights.point_to_point_share, "in [0, 1]");
  } else if (!(schedule.final_stiffness > 0.0)) {
    bad("final_stiffness", schedule.final_stiffness, "> 0");
  } else if (!(schedule.initial_stiffness >= schedule.final_stiffness)) {
    bad("initial_stiffness", schedule.initial_stiffness, "at least final_stiffness");
  } else if (!(schedule.noise_stiffness >= 0.0)) {
    bad("noise_stiffness", schedule.noise_stiffness, ">= 0");
  } else if (schedule.levels < 1 || schedule.levels > kMaxLevels) {
    bad("levels", schedule.levels, "in [1, 5]");
  } else if (std::min({schedule.coarse_steps,
                       schedule.fine_steps,
                       schedule.max_rounds,
                       schedule.solver_iterations}) < 1) {
    message << "coarse_steps, fine_steps, max_rounds and solver_iterations are expected >= 1";
  } else if (!(schedule.tolerance > 0.0)) {
    bad("tolerance", schedule.tolerance, "> 0");
  } else if (!(std::min(loss_width, careful_loss_width) > 0.0)) {
    bad("loss_width or careful_loss_width", std::min(loss_width, careful_loss_width), "> 0");
  } else if (!(careful_angle_deg > 0.0 && careful_angle_deg <= 180.0)) {
    bad("careful_angle_deg", careful_angle_deg, "in (0, 180]");
  } else if (max_samples < 10) {
    bad("max_samples", max_samples, ">= 10");
  } else if (num_threads < 1) {
    bad("num_threads", num_threads, ">= 1");
  } else if (!(time_limit_s > 0.0)) {
    bad("time_limit_s", time_limit_s, "> 0 seconds");
  }
  *error = message.str();
  return error->empty();
}

Status ValidateSource(const PointCloud& source) {
  if (source.size() < kMinPoints) {
    return Status::Error("the source has " + std::to_string(source.size()) +
                         " points, a fit needs at least " + std::to_string(kMinPoints));
  }
  if (Diagonal(source.points) > 0.0) return Status::Ok();
  return Status::Error("the source has no extent: all its points coincide");
}

Status ValidateFit(const FitInput& input, const FitOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) return Status::Error(error);
  if (Status status = ValidateSource(input.source); !status.ok()) return status;
  if (Status status = CheckPoints(input); !status.ok()) return status;
  return CheckScale(input, options);
}

}  // namespace ceres_ed
