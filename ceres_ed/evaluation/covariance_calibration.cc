#include "ceres_ed/evaluation/covariance_calibration.h"

#include <ceres_ed/io/cloud_io.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

struct Point {
  double error = 0.0;
  double deviation = 0.0;
  // The probability level.
  double level = 0.0;
  double negative_log_likelihood = 0.0;
};

// Returns the chi-square distribution of three degrees of freedom.
double ChiSquare3(double x) {
  return std::erf(std::sqrt(0.5 * x)) - std::sqrt(2.0 * x / M_PI) * std::exp(-0.5 * x);
}

// Returns nothing if the covariance is not positive definite.
std::optional<Point> MakePoint(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return std::nullopt;
  const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const double squared = error.dot(factor.solve(error));
  const double log_determinant =
      2.0 * Eigen::Matrix3d(factor.matrixL()).diagonal().array().log().sum();
  Point point;
  point.error = error.norm();
  point.deviation = std::sqrt(covariance.trace());
  point.level = ChiSquare3(squared);
  point.negative_log_likelihood = 0.5 * (squared + log_determinant + 3.0 * std::log(2.0 * M_PI));
  return point;
}

// Returns the ranks of values, equal ones sharing their mean rank.
std::vector<double> Ranks(const std::vector<double>& values) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      ranks[order[i]] = 0.5 * static_cast<double>(begin + end - 1);
    }
    begin = end;
  }
  return ranks;
}

double RankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> ranks_a = Ranks(a);
  const std::vector<double> ranks_b = Ranks(b);
  const double mean = 0.5 * static_cast<double>(a.size() - 1);
  double product = 0.0;
  double square_a = 0.0;
  double square_b = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    product += (ranks_a[i] - mean) * (ranks_b[i] - mean);
    square_a += (ranks_a[i] - mean) * (ranks_a[i] - mean);
    square_b += (ranks_b[i] - mean) * (ranks_b[i] - mean);
  }
  return square_a > 0.0 && square_b > 0.0 ? product / std::sqrt(square_a * square_b) : 0.0;
}

// Returns the mean, over n = 1, 2, ..., of the mean error of the n points that come first by `key`.
double MeanOfLeft(const std::vector<double>& errors, const std::vector<double>& key) {
  std::vector<int> order(errors.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  double sum = 0.0;
  double area = 0.0;
  double count = 0.0;
  for (const int p : order) {
    sum += errors[p];
    count += 1.0;
    area += sum / count;
  }
  return area / count;
}

std::optional<Calibration> CalibrationOf(const std::vector<Point>& points) {
  if (points.size() < 2) return std::nullopt;
  const auto size = static_cast<double>(points.size());
  const auto share_inside = [&](double level) {
    return static_cast<double>(
               std::count_if(points.begin(),
                             points.end(),
                             [level](const Point& p) { return p.level <= level; })) /
           size;
  };
  Calibration calibration;
  calibration.points = static_cast<int>(points.size());
  calibration.coverage_50 = share_inside(0.5);
  calibration.coverage_80 = share_inside(0.8);
  calibration.coverage_95 = share_inside(0.95);
  for (std::size_t i = 0; i < calibration.reliability.size(); ++i) {
    calibration.reliability[i] = share_inside(0.1 * static_cast<double>(i + 1));
  }
  std::vector<double> errors;
  std::vector<double> deviations;
  double sum = 0.0;
  for (const Point& point : points) {
    errors.push_back(point.error);
    deviations.push_back(point.deviation);
    calibration.negative_log_likelihood += point.negative_log_likelihood / size;
    sum += point.error;
  }
  const double oracle = MeanOfLeft(errors, errors);
  const double useless = sum / size - oracle;
  if (useless > 0.0) calibration.ause = (MeanOfLeft(errors, deviations) - oracle) / useless;
  calibration.rank_correlation = RankCorrelation(deviations, errors);
  return calibration;
}

}  // namespace

CalibrationFigures MeasureCalibration(const std::vector<Eigen::Vector3d>& errors,
                                      const std::vector<Eigen::Matrix3d>& covariances,
                                      const std::vector<char>& is_seen) {
  CHECK_EQ(errors.size(), covariances.size());
  CHECK_EQ(errors.size(), is_seen.size());
  CalibrationFigures figures;
  std::vector<Point> all;
  std::vector<Point> seen;
  std::vector<Point> hidden;
  for (std::size_t p = 0; p < errors.size(); ++p) {
    const std::optional<Point> point = MakePoint(errors[p], covariances[p]);
    if (!point) {
      ++figures.unknown;
      continue;
    }
    all.push_back(*point);
    (is_seen[p] != 0 ? seen : hidden).push_back(*point);
  }
  figures.all = CalibrationOf(all);
  figures.seen = CalibrationOf(seen);
  figures.hidden = CalibrationOf(hidden);
  return figures;
}

StatusOr<std::vector<Eigen::Matrix3d>> ReadCovariances(const std::string& path) {
  const StatusOr<LoadedCloud> loaded = LoadCloud(path);
  if (!loaded.ok()) return loaded.status();
  std::array<const PlyProperty*, 6> columns = {};
  std::size_t next = 0;
  for (const char* const name : {"xx", "xy", "xz", "yy", "yz", "zz"}) {
    const PlyProperty* const column = loaded->document.Find("vertex")->Find(name);
    if (column == nullptr || column->is_list) {
      return Status::Error(path + ": element vertex has no property " + name +
                           ", expected xx xy xz yy yz zz as ed_fit --covariance writes them");
    }
    columns[next++] = column;
  }
  std::vector<Eigen::Matrix3d> covariances;
  covariances.reserve(loaded->cloud.size());
  for (const int row : loaded->vertex_of_point) {
    const auto at = [&columns, row](int i) { return columns[i]->values[row]; };
    Eigen::Matrix3d covariance;
    covariance << at(0), at(1), at(2), at(1), at(3), at(4), at(2), at(4), at(5);
    covariances.push_back(at(0) < 0.0 ? Eigen::Matrix3d::Zero() : covariance);
  }
  return covariances;
}

}  // namespace ceres_ed
