#include "ceres_ed/stereo/pair_check.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

namespace ceres_ed {
namespace {

constexpr int kFewestCorners = 30;
constexpr double kUnrectified = 3.0;
constexpr double kRough = 1.0;
// A corner is behind infinity by more than this.
constexpr double kBehind = 2.0;

cv::Mat Wrap(const Image<std::uint8_t>& image) {
  return {image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.pixels().data())};
}

// A corner in both pictures: u_left - u_right and v_right - v_left.
struct Displacement {
  double disparity = 0.0;
  double rows = 0.0;
};

// Returns the corners that choose each other, with a clear distance to the second choice.
std::vector<Displacement> MatchCorners(const GrayImage& left,
                                       const GrayImage& right,
                                       const MaskImage& left_mask) {
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(2000, 1.2F, 4);
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
    matches.push_back({static_cast<double>(a.x - b.x), static_cast<double>(b.y - a.y)});
  }
  return matches;
}

// Keeps the corners whose rows differ by about as much as those of most: the others are wrong.
void KeepConsistent(double width, std::vector<Displacement>* matches) {
  std::vector<double> rows;
  for (const Displacement& m : *matches) rows.push_back(m.rows);
  std::sort(rows.begin(), rows.end());
  // The densest interval of this width.
  std::size_t best = 0, best_count = 0;
  for (std::size_t i = 0, j = 0; i < rows.size(); ++i) {
    while (j < rows.size() && rows[j] - rows[i] <= width) ++j;
    if (j - i > best_count) {
      best = i;
      best_count = j - i;
    }
  }
  if (rows.empty()) return;
  const double low = rows[best];
  matches->erase(
      std::remove_if(matches->begin(),
                     matches->end(),
                     [&](const Displacement& m) { return m.rows < low || m.rows > low + width; }),
      matches->end());
}

}  // namespace

double PairFindings::RowError() const { return std::abs(row_difference) + row_spread; }

bool PairFindings::IsSwapped() const { return corners >= kFewestCorners && behind > 0.7; }

bool PairFindings::IsUnrectified() const {
  return corners >= kFewestCorners && RowError() > kUnrectified;
}

bool PairFindings::IsRough() const { return corners >= kFewestCorners && RowError() > kRough; }

PairFindings CheckPair(const GrayImage& left,
                       const GrayImage& right,
                       const MaskImage& left_mask,
                       double offset) {
  std::vector<Displacement> matches = MatchCorners(left, right, left_mask);
  // Rows that do not correspond may differ in other ways at the top and at the bottom.
  KeepConsistent(0.05 * left.height(), &matches);
  PairFindings findings;
  findings.corners = static_cast<int>(matches.size());
  if (matches.empty()) return findings;
  std::vector<double> rows;
  int behind = 0;
  for (const Displacement& m : matches) {
    rows.push_back(m.rows);
    if (m.disparity < offset - kBehind) ++behind;
  }
  findings.row_difference = Median(rows);
  for (double& row : rows) row = std::abs(row - findings.row_difference);
  findings.row_spread = Median(rows);
  findings.behind = behind / static_cast<double>(matches.size());
  return findings;
}

}  // namespace ceres_ed
