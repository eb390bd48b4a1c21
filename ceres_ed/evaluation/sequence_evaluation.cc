#include "ceres_ed/evaluation/sequence_evaluation.h"

#include <ceres_ed/geometry/visibility_buffer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

std::optional<DistanceStatistics> SummarizeAny(const std::vector<double>& distances) {
  if (distances.empty()) return std::nullopt;
  return Summarize(distances);
}

}  // namespace

bool SequenceEvaluationOptions::IsValid(std::string* error) const {
  const auto refuse = [error](const char* name, double value) {
    *error = std::string(name) + " is " + std::to_string(value) + ", expected a number > 0";
    return false;
  };
  if (!(max_birth_offset > 0.0)) return refuse("max_birth_offset", max_birth_offset);
  if (!(visibility_tolerance > 0.0)) return refuse("visibility_tolerance", visibility_tolerance);
  if (!(far_residual > 0.0)) return refuse("far_residual", far_residual);
  return true;
}

TruthEvaluator::TruthEvaluator(const PinholeCamera& camera,
                               const SceneTruth& truth,
                               const SequenceEvaluationOptions& options)
    : camera_(camera), truth_(truth), options_(options) {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
}

Status TruthEvaluator::LocateNewPoints(const LiveSnapshot& snapshot, const TrueSurface& surface) {
  std::map<int, std::vector<std::size_t>> new_points;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    const int born = snapshot.birth_frames[i];
    const std::string point = "point " + std::to_string(snapshot.ids[i]);
    const auto known = births_.find(snapshot.ids[i]);
    if (known == births_.end()) {
      if (born > snapshot.frame || !truth_.Has(born)) {
        return Status::Error(point + " was born in frame " + std::to_string(born) +
                             ", expected a frame of the sequence up to " +
                             std::to_string(snapshot.frame));
      }
      new_points[born].push_back(i);
    } else if (known->second.frame != born) {
      return Status::Error(point + " was born in frame " + std::to_string(born) +
                           ", expected frame " + std::to_string(known->second.frame) +
                           " as in an earlier live cloud");
    }
  }
  for (const auto& [frame, indices] : new_points) {
    std::unique_ptr<TrueSurface> earlier;
    if (frame != snapshot.frame) earlier = std::make_unique<TrueSurface>(truth_.InCamera(frame));
    const TrueSurface& at_birth = earlier ? *earlier : surface;
    for (const std::size_t i : indices) {
      const Eigen::Vector3d& place = snapshot.birth_points[i];
      const double bound = options_.max_birth_offset * std::abs(place.z());
      births_[snapshot.ids[i]] = {frame, at_birth.Locate(place, bound)};
    }
  }
  return Status::Ok();
}

Status TruthEvaluator::CheckFrame(const LiveSnapshot& snapshot) const {
  if (truth_.Has(snapshot.frame)) return Status::Ok();
  return Status::Error("the truth has no frame " + std::to_string(snapshot.frame) +
                       ", expected mesh and pose of every frame of the result");
}

double TruthEvaluator::TrackingError(const LiveSnapshot& snapshot,
                                     std::size_t point,
                                     const TrueSurface& surface) const {
  const TissuePoint& tissue = births_.at(snapshot.ids[point]).tissue;
  if (!tissue.known()) return std::numeric_limits<double>::quiet_NaN();
  return (snapshot.points[point] - surface.PlaceOf(tissue)).norm();
}

StatusOr<std::vector<double>> TruthEvaluator::TrackingErrors(const LiveSnapshot& snapshot) {
  Status status = CheckFrame(snapshot);
  if (!status.ok()) return status;
  const TrueSurface surface(truth_.InCamera(snapshot.frame));
  status = LocateNewPoints(snapshot, surface);
  if (!status.ok()) return status;
  std::vector<double> errors(snapshot.size());
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = TrackingError(snapshot, i, surface);
  return errors;
}

StatusOr<FrameTruthError> TruthEvaluator::Evaluate(const LiveSnapshot& snapshot) {
  Status status = CheckFrame(snapshot);
  if (!status.ok()) return status;
  const TrueSurface surface(truth_.InCamera(snapshot.frame));
  status = LocateNewPoints(snapshot, surface);
  if (!status.ok()) return status;
  VisibilityBuffer buffer(camera_);
  buffer.AddTriangles(surface.mesh());

  FrameTruthError error;
  error.frame = snapshot.frame;
  error.points = static_cast<int>(snapshot.size());
  std::vector<double> surface_all, surface_seen, tracking_seen, tracking_hidden;
  surface_all.reserve(snapshot.size());
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    const Eigen::Vector3d& point = snapshot.points[i];
    const bool seen = buffer.Sees(point, options_.visibility_tolerance);
    surface_all.push_back(surface.Distance(point));
    if (seen) surface_seen.push_back(surface_all.back());
    const double tracking = TrackingError(snapshot, i, surface);
    if (std::isnan(tracking)) {
      ++error.unknown;
      continue;
    }
    (seen ? tracking_seen : tracking_hidden).push_back(tracking);
  }
  error.seen = static_cast<int>(surface_seen.size());
  error.surface_all = SummarizeAny(surface_all);
  error.surface_seen = SummarizeAny(surface_seen);
  error.tracking_seen = SummarizeAny(tracking_seen);
  error.tracking_hidden = SummarizeAny(tracking_hidden);
  return error;
}

DepthAgreement CompareWithDepth(const PinholeCamera& camera,
                                const LiveSnapshot& snapshot,
                                const DepthImage& depth,
                                const SequenceEvaluationOptions& options) {
  CHECK_EQ(depth.width(), camera.width);
  CHECK_EQ(depth.height(), camera.height);
  VisibilityBuffer buffer(camera);
  buffer.AddPoints(snapshot.points);
  DepthAgreement agreement;
  agreement.frame = snapshot.frame;
  agreement.points = static_cast<int>(snapshot.size());
  std::vector<double> residuals;
  for (const Eigen::Vector3d& point : snapshot.points) {
    if (!buffer.Sees(point, options.visibility_tolerance)) continue;
    ++agreement.seen;
    const auto [u, v] = *PixelOf(camera, point);
    const double measured = depth(u, v);
    if (measured > 0.0) residuals.push_back(std::abs(point.z() - measured));
  }
  agreement.measured = static_cast<int>(residuals.size());
  agreement.residual = SummarizeAny(residuals);
  if (residuals.empty()) return agreement;
  const auto far = std::count_if(residuals.begin(), residuals.end(), [&](double residual) {
    return residual > options.far_residual;
  });
  agreement.far_share = static_cast<double>(far) / static_cast<double>(residuals.size());
  return agreement;
}

AcrossFrames SummarizeFrames(const std::vector<std::optional<double>>& values) {
  std::vector<double> present;
  for (const std::optional<double>& value : values) {
    if (value) present.push_back(*value);
  }
  const DistanceStatistics statistics = Summarize(present);
  return {statistics.mean, statistics.p50, statistics.max, static_cast<int>(present.size())};
}

}  // namespace ceres_ed
