#include "ceres_ed/registration/fit_validation.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace ceres_ed {
namespace {

// The largest ratio of the diagonals of source and target. Millimetres against metres is a factor
// of 1000, and a partial view of a body is rarely smaller than a tenth of it.
constexpr double kMaxScaleRatio = 25.0;
constexpr int kMinPoints = 4;

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
  for (const Landmark& landmark : input.landmarks) {
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
  const double source = options.rigid.initial_scale * Diagonal(input.source.points);
  if (input.target.empty()) return Status::Ok();
  const double target = Diagonal(input.target.points);
  if (!(target > 0.0)) return Status::Error("the target has no extent: all its points coincide");
  const double ratio = std::max(source / target, target / source);
  if (ratio <= kMaxScaleRatio || options.rigid.with_scale) return Status::Ok();
  std::ostringstream message;
  message << "source and target have very different sizes: their diagonals are " << source
          << " and " << target << " (at most a factor of " << kMaxScaleRatio
          << " is expected; are the units the same? --scale=auto finds the factor)";
  return Status::Error(message.str());
}

}  // namespace

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
