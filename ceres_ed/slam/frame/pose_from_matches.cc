#include "ceres_ed/slam/frame/pose_from_matches.h"

#include <ceres_ed/util/random.h>

#include <algorithm>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

constexpr int kSamples = 500;
// Points of a sample that are nearer to each other than this, in map units, determine no rotation.
constexpr double kLeastSpread = 1.0;

// Returns the pose that moves the chosen matches onto one another (Umeyama 1991).
CameraPose Fit(const std::vector<PointMatch>& matches, const std::vector<int>& chosen) {
  Eigen::Matrix3Xd from(3, chosen.size()), to(3, chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    from.col(static_cast<Eigen::Index>(k)) = matches[chosen[k]].in_map;
    to.col(static_cast<Eigen::Index>(k)) = matches[chosen[k]].in_camera;
  }
  const Eigen::Matrix4d transform = Eigen::umeyama(from, to, /*with_scaling=*/false);
  CameraPose pose;
  pose.rotation = Eigen::Quaterniond(Eigen::Matrix3d(transform.topLeftCorner<3, 3>())).normalized();
  pose.translation = transform.topRightCorner<3, 1>();
  return pose;
}

std::vector<int> Agreeing(const std::vector<PointMatch>& matches,
                          const CameraPose& pose,
                          double tolerance) {
  std::vector<int> agreeing;
  for (int k = 0; k < static_cast<int>(matches.size()); ++k) {
    if ((pose * matches[k].in_map - matches[k].in_camera).norm() < tolerance) agreeing.push_back(k);
  }
  return agreeing;
}

bool IsSpread(const std::vector<PointMatch>& matches, const std::vector<int>& sample) {
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& a = matches[sample[k]].in_map;
    const Eigen::Vector3d& b = matches[sample[(k + 1) % 3]].in_map;
    if ((a - b).norm() < kLeastSpread) return false;
  }
  return true;
}

}  // namespace

std::optional<CameraPose> PoseFromMatches(const std::vector<PointMatch>& matches,
                                          double tolerance,
                                          int fewest) {
  const int count = static_cast<int>(matches.size());
  if (count < std::max(3, fewest)) return std::nullopt;
  Random random(1);
  const auto draw = [&] { return std::min(count - 1, static_cast<int>(random.Uniform() * count)); };
  std::vector<int> best;
  for (int i = 0; i < kSamples; ++i) {
    const std::vector<int> sample = {draw(), draw(), draw()};
    if (!IsSpread(matches, sample)) continue;
    std::vector<int> agreeing = Agreeing(matches, Fit(matches, sample), tolerance);
    if (agreeing.size() > best.size()) best = std::move(agreeing);
  }
  if (static_cast<int>(best.size()) < fewest) return std::nullopt;
  const CameraPose pose = Fit(matches, best);
  if (static_cast<int>(Agreeing(matches, pose, tolerance).size()) < fewest) return std::nullopt;
  return pose;
}

}  // namespace ceres_ed
