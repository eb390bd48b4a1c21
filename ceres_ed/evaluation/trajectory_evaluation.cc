#include "ceres_ed/evaluation/trajectory_evaluation.h"

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/geometry/similarity.h>

#include <algorithm>

#include <Eigen/SVD>

namespace ceres_ed {
namespace {

constexpr double kDegreesPerRadian = 180.0 / 3.14159265358979323846;

struct PosePair {
  int frame;
  CameraPose estimate;
  CameraPose truth;
};

// Returns the rotation that is closest to all of truth * estimate^-1 (chordal mean), and the
// translation between the mean centres.
Similarity AlignOrientations(const std::vector<PosePair>& pairs) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d estimate_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d truth_mean = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) {
    sum += (pair.truth.rotation * pair.estimate.rotation.conjugate()).toRotationMatrix();
    estimate_mean += pair.estimate.translation / static_cast<double>(pairs.size());
    truth_mean += pair.truth.translation / static_cast<double>(pairs.size());
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if (u.determinant() * svd.matrixV().determinant() < 0.0) u.col(2) = -u.col(2);
  Similarity alignment;
  alignment.rotation = Eigen::Quaterniond(u * svd.matrixV().transpose());
  alignment.translation = truth_mean - alignment.rotation * estimate_mean;
  return alignment;
}

Similarity BestAlignment(const std::vector<PosePair>& pairs) {
  std::vector<Eigen::Vector3d> from, to;
  for (const PosePair& pair : pairs) {
    from.push_back(pair.estimate.translation);
    to.push_back(pair.truth.translation);
  }
  const StatusOr<Similarity> fitted = Similarity::FitPoints(from, to);
  return fitted.ok() ? *fitted : AlignOrientations(pairs);
}

// Returns the errors after `alignment`, which maps the world of the estimate to that of the truth.
TrajectoryError ErrorAfter(const Similarity& alignment, const std::vector<PosePair>& pairs) {
  TrajectoryError error;
  std::vector<double> translations, rotations;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d centre = alignment * pair.estimate.translation;
    const Eigen::Quaterniond rotation = alignment.rotation * pair.estimate.rotation;
    PoseError frame;
    frame.frame = pair.frame;
    frame.translation = (centre - pair.truth.translation).norm();
    frame.rotation_deg = rotation.angularDistance(pair.truth.rotation) * kDegreesPerRadian;
    error.frames.push_back(frame);
    translations.push_back(frame.translation);
    rotations.push_back(frame.rotation_deg);
  }
  const DistanceStatistics translation = Summarize(translations);
  const DistanceStatistics rotation = Summarize(rotations);
  error.translation_rmse = translation.rms;
  error.translation_mean = translation.mean;
  error.translation_median = translation.p50;
  error.translation_max = translation.max;
  error.rotation_mean_deg = rotation.mean;
  error.rotation_max_deg = rotation.max;
  return error;
}

}  // namespace

StatusOr<TrajectoryEvaluation> EvaluateTrajectory(const std::map<int, CameraPose>& estimate,
                                                  const std::map<int, CameraPose>& truth) {
  std::vector<PosePair> pairs;
  for (const auto& [frame, pose] : estimate) {
    const auto found = truth.find(frame);
    if (found != truth.end()) pairs.push_back({frame, pose, found->second});
  }
  if (pairs.empty()) {
    return Status::Error("no frame is in both the estimated and the true trajectory, expected one");
  }
  Similarity first;
  first.rotation = pairs[0].truth.rotation * pairs[0].estimate.rotation.conjugate();
  first.translation = pairs[0].truth.translation - first.rotation * pairs[0].estimate.translation;
  return TrajectoryEvaluation{ErrorAfter(first, pairs), ErrorAfter(BestAlignment(pairs), pairs)};
}

}  // namespace ceres_ed
