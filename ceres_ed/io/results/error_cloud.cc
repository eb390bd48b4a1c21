#include "ceres_ed/io/results/error_cloud.h"

#include <ceres_ed/io/cloud_io.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Returns a colour from blue over white to red for t in [0, 1].
std::array<std::uint8_t, 3> HeatColor(double t) {
  const auto channel = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  return {channel(2.0 * t), channel(1.0 - std::abs(2.0 * t - 1.0)), channel(2.0 - 2.0 * t)};
}

}  // namespace

Status WriteErrorCloud(const std::string& path,
                       const PointCloud& cloud,
                       const std::vector<double>& errors,
                       double full_scale,
                       std::vector<std::string>* losses) {
  CHECK_EQ(errors.size(), cloud.size());
  CloudWriteOptions options;
  options.losses = losses;
  options.colors.reserve(errors.size());
  for (const double error : errors) {
    options.colors.push_back(HeatColor(full_scale > 0.0 ? std::min(error / full_scale, 1.0) : 0.0));
  }
  options.columns.push_back(MakePlyScalar("error", PlyType::kFloat32, errors));
  return WriteCloud(path, cloud, options);
}

}  // namespace ceres_ed
