// Compares predicted covariances of points with their errors.
#ifndef CERES_ED_EVALUATION_COVARIANCE_CALIBRATION_H_
#define CERES_ED_EVALUATION_COVARIANCE_CALIBRATION_H_

#include <ceres_ed/util/status.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// How well covariances predict errors. The probability level of a point is that of the ellipsoid on
// whose surface its true position lies: F(e^T C^-1 e), with F the chi-square distribution of three
// degrees of freedom. If the covariances are right, the levels are uniform in [0, 1].
struct Calibration {
  int points = 0;
  // The share of points inside their ellipsoids of 50, 80 and 95 %.
  double coverage_50 = 0.0;
  double coverage_80 = 0.0;
  double coverage_95 = 0.0;
  // The shares inside those of 10, 20, ..., 90 %: the reliability curve.
  std::array<double, 9> reliability = {};
  // The mean of 1/2 (e^T C^-1 e + ln det C + 3 ln 2 pi), in nats. It depends on the unit of length.
  double negative_log_likelihood = 0.0;
  // The area under the sparsification error: how much larger the mean error of the points that are
  // left is if points are removed by their standard deviation instead of by their error, averaged
  // over the number of points that are left, and divided by the same for an order that says
  // nothing. 0 is perfect, 1 useless.
  double ause = 0.0;
  // Spearman's rank correlation of standard deviation and error.
  double rank_correlation = 0.0;
};

// Returns the figures of all points, and of those that `is_seen` has or does not have. `errors` are
// result minus truth. Points whose covariance is not positive definite are left out; nothing is
// returned for a part with fewer than two points. CHECKs that the sizes agree.
struct CalibrationFigures {
  std::optional<Calibration> all;
  std::optional<Calibration> seen;
  std::optional<Calibration> hidden;
  // The number of points without a usable covariance.
  int unknown = 0;
};
CalibrationFigures MeasureCalibration(const std::vector<Eigen::Vector3d>& errors,
                                      const std::vector<Eigen::Matrix3d>& covariances,
                                      const std::vector<char>& is_seen);

// Reads the covariances that ed_fit --covariance=FILE has written: one for each vertex, zero where
// nothing is known. Errors name the file, and the property that is missing.
StatusOr<std::vector<Eigen::Matrix3d>> ReadCovariances(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_COVARIANCE_CALIBRATION_H_
