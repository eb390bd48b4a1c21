#include "ceres_ed/stereo/pair_check.h"

#include <ceres_ed/util/random.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

namespace ceres_ed {
namespace {

constexpr int kFewestCorners = 20;
constexpr double kLeastShare = 0.3;
// A corner is behind infinity by more than this.
constexpr double kBehind = 2.0;

cv::Mat Wrap(const Image<std::uint8_t>& image) {
  return {image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.pixels().data())};
}

// A corner in both pictures: u_left - u_right and v_right - v_left.
struct Displacement {
  // In the left picture.
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double disparity = 0.0;
  double rows = 0.0;
};

// Returns the corners that choose each other, with a clear distance to the second choice.
std::vector<Displacement> MatchCorners(const GrayImage& left,
                                       const GrayImage& right,
                                       const MaskImage& left_mask) {
  const cv::Ptr<cv::ORB> orb =
      cv::ORB::create(2000, 1.2F, 4, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31, /*fastThreshold=*/7);
  std::vector<cv::KeyPoint> left_points, right_points;
  cv::Mat left_looks, right_looks;
  orb->detectAndCompute(Wrap(left), Wrap(left_mask), left_points, left_looks);
  orb->detectAndCompute(Wrap(right), cv::noArray(), right_points, right_looks);
  std::vector<Displacement> matches;
  if (left_looks.rows < 2 || right_looks.rows < 2) return matches;
  const cv::BFMatcher matcher(cv::NORM_HAMMING);
  std::vector<std::vector<cv::DMatch>> there;
  std::vector<cv::DMatch> back;
  matcher.knnMatch(left_looks, right_looks, there, 2);
  matcher.match(right_looks, left_looks, back);
  constexpr float kRatio = 0.8F;
  for (const std::vector<cv::DMatch>& best : there) {
    if (best.size() < 2 || best[0].distance > kRatio * best[1].distance) continue;
    const cv::DMatch& m = best[0];
    if (back[static_cast<std::size_t>(m.trainIdx)].trainIdx != m.queryIdx) continue;
    const cv::Point2f a = left_points[static_cast<std::size_t>(m.queryIdx)].pt;
    const cv::Point2f b = right_points[static_cast<std::size_t>(m.trainIdx)].pt;
    Displacement displacement;
    displacement.place = Eigen::Vector2d(a.x, a.y);
    displacement.disparity = static_cast<double>(a.x - b.x);
    displacement.rows = static_cast<double>(b.y - a.y);
    matches.push_back(displacement);
  }
  return matches;
}

// v_right - v_left as an affine function of the place in the left picture.
using RowModel = Eigen::Vector3d;

double Predict(const RowModel& model, const Displacement& m) {
  return model.dot(Eigen::Vector3d(m.place.x(), m.place.y(), 1.0));
}

// Returns the corners that agree with the row model with which most agree, by random sampling.
std::vector<Displacement> MostConsistent(const std::vector<Displacement>& matches,
                                         double tolerance) {
  constexpr int kTrials = 500;
  std::vector<Displacement> best;
  if (matches.size() < 3) return best;
  Random random(1);
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::Matrix3d places;
    Eigen::Vector3d rows;
    for (int k = 0; k < 3; ++k) {
      const auto index =
          static_cast<std::size_t>(random.Uniform() * static_cast<double>(matches.size()));
      const Displacement& m = matches[std::min(index, matches.size() - 1)];
      places.row(k) << m.place.x(), m.place.y(), 1.0;
      rows[k] = m.rows;
    }
    const RowModel model = places.fullPivLu().solve(rows);
    // Rows that change faster than this are those of no camera.
    constexpr double kLargestSlope = 0.2;
    if (!model.allFinite() || model.head(2).norm() > kLargestSlope) continue;
    std::vector<Displacement> agreeing;
    for (const Displacement& m : matches) {
      if (std::abs(m.rows - Predict(model, m)) <= tolerance) agreeing.push_back(m);
    }
    if (agreeing.size() > best.size()) best = std::move(agreeing);
  }
  return best;
}

}  // namespace

PairFindings CheckPair(const GrayImage& left,
                       const GrayImage& right,
                       const MaskImage& left_mask,
                       double offset) {
  // Corners are located to about a pixel of a picture with 480 rows.
  const double tolerance = 1.5 * std::max(1.0, left.height() / 480.0);
  const std::vector<Displacement> matches = MatchCorners(left, right, left_mask);
  const std::vector<Displacement> consistent = MostConsistent(matches, tolerance);
  PairFindings findings;
  findings.corners = static_cast<int>(consistent.size());
  findings.is_conclusive = findings.corners >= kFewestCorners &&
                           findings.corners >= kLeastShare * static_cast<double>(matches.size());
  if (consistent.empty()) return findings;
  std::vector<double> rows;
  int behind = 0;
  for (const Displacement& m : consistent) {
    rows.push_back(std::abs(m.rows));
    if (m.disparity < offset - kBehind) ++behind;
  }
  findings.row_error = Median(std::move(rows)) / std::max(1.0, left.height() / 480.0);
  findings.behind = behind / static_cast<double>(consistent.size());
  return findings;
}

}  // namespace ceres_ed
