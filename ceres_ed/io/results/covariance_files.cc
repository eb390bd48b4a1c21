#include "ceres_ed/io/results/covariance_files.h"

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/text_rows.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

constexpr std::array<const char*, 6> kMotions = {"tx", "ty", "tz", "rx", "ry", "rz"};
constexpr std::array<const char*, 6> kNames = {"xx", "xy", "xz", "yy", "yz", "zz"};
constexpr std::array<std::array<int, 2>, 6> kEntries = {
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
constexpr double kUnknown = -1.0;

}  // namespace

std::string CameraCovarianceHeader() {
  std::string header = "frame";
  for (std::size_t row = 0; row < kMotions.size(); ++row) {
    for (std::size_t column = row; column < kMotions.size(); ++column) {
      header += std::string(",") + kMotions[row] + "_" + kMotions[column];
    }
  }
  return header + "\n";
}

std::string CameraCovarianceRow(int frame, const Eigen::Matrix<double, 6, 6>& covariance) {
  std::string text = std::to_string(frame);
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      std::string number;
      AppendNumbers({covariance(row, column)}, &number);
      text += "," + number;
    }
  }
  return text + "\n";
}

Status WriteMapCovariances(const std::string& path, const MapCovariances& map) {
  PointCloud cloud;
  cloud.points = map.points;
  CloudWriteOptions options;
  options.double_precision = true;
  options.comments = {
      "map frame, metres; covariances of x y z and std_dev, the root of their trace; -1: unknown"};
  options.columns = {
      MakePlyScalar("id", PlyType::kInt32, std::vector<double>(map.ids.begin(), map.ids.end()))};
  const auto add = [&](const char* name, const auto& value) {
    std::vector<double> values;
    values.reserve(map.covariances.size());
    for (const Eigen::Matrix3d& covariance : map.covariances) {
      values.push_back(covariance.allFinite() ? value(covariance) : kUnknown);
    }
    options.columns.push_back(MakePlyScalar(name, PlyType::kFloat64, std::move(values)));
  };
  for (std::size_t entry = 0; entry < kNames.size(); ++entry) {
    add(kNames[entry], [&](const Eigen::Matrix3d& covariance) {
      return covariance(kEntries[entry][0], kEntries[entry][1]);
    });
  }
  add("std_dev", [](const Eigen::Matrix3d& covariance) { return std::sqrt(covariance.trace()); });
  return WriteCloud(path, cloud, options);
}

}  // namespace ceres_ed
