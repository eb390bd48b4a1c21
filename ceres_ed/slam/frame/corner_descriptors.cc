#include "ceres_ed/slam/frame/corner_descriptors.h"

#include <algorithm>
#include <cstring>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

namespace ceres_ed {
namespace {

// The largest number of different bits of a match, and how much nearer than the second nearest
// descriptor it has to be.
constexpr float kMostBits = 64.0f;
constexpr float kClearlyNearer = 0.85f;

bool IsDescribed(const CornerDescriptor& descriptor) {
  return std::any_of(descriptor.begin(), descriptor.end(), [](std::uint8_t b) { return b != 0; });
}

// Returns the described rows as a matrix, and their indices.
cv::Mat Rows(const std::vector<CornerDescriptor>& descriptors, std::vector<int>* indices) {
  for (int i = 0; i < static_cast<int>(descriptors.size()); ++i) {
    if (IsDescribed(descriptors[i])) indices->push_back(i);
  }
  cv::Mat rows(static_cast<int>(indices->size()), 32, CV_8UC1);
  for (int row = 0; row < rows.rows; ++row) {
    std::memcpy(rows.ptr(row), descriptors[(*indices)[row]].data(), 32);
  }
  return rows;
}

// Returns for each row of `from` the clearly nearest row of `to`, or -1.
std::vector<int> Nearest(const cv::Mat& from, const cv::Mat& to) {
  std::vector<int> nearest(from.rows, -1);
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(cv::NORM_HAMMING).knnMatch(from, to, matches, 2);
  for (const std::vector<cv::DMatch>& best : matches) {
    if (best.empty() || best[0].distance > kMostBits) continue;
    if (best.size() > 1 && best[0].distance > kClearlyNearer * best[1].distance) continue;
    nearest[best[0].queryIdx] = best[0].trainIdx;
  }
  return nearest;
}

}  // namespace

std::vector<CornerDescriptor> DescribeCorners(ImageView<std::uint8_t> picture,
                                              const std::vector<Eigen::Vector2d>& pixels) {
  std::vector<CornerDescriptor> descriptors(pixels.size(), CornerDescriptor{});
  if (picture.empty() || pixels.empty()) return descriptors;
  const cv::Mat image(picture.height(),
                      picture.width(),
                      CV_8UC1,
                      const_cast<void*>(static_cast<const void*>(picture.pixels())));
  constexpr float kPatch = 31.0f;
  std::vector<cv::KeyPoint> keypoints;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    cv::KeyPoint keypoint(
        static_cast<float>(pixels[i].x()), static_cast<float>(pixels[i].y()), kPatch);
    // OpenCV drops some corners; this tells which are left.
    keypoint.class_id = static_cast<int>(i);
    keypoints.push_back(keypoint);
  }
  // The angle is that from the corner to the centroid of the brightness around it.
  constexpr int kRadius = 15;
  for (cv::KeyPoint& keypoint : keypoints) {
    const int u = cvRound(keypoint.pt.x);
    const int v = cvRound(keypoint.pt.y);
    double mu = 0.0, mv = 0.0;
    for (int y = -kRadius; y <= kRadius; ++y) {
      for (int x = -kRadius; x <= kRadius; ++x) {
        if (x * x + y * y > kRadius * kRadius || v + y < 0 || u + x < 0 || v + y >= image.rows ||
            u + x >= image.cols) {
          continue;
        }
        const double value = image.at<unsigned char>(v + y, u + x);
        mu += value * x;
        mv += value * y;
      }
    }
    keypoint.angle = cv::fastAtan2(static_cast<float>(mv), static_cast<float>(mu));
  }
  cv::Mat rows;
  cv::ORB::create(500, 1.2f, 1, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31)
      ->compute(image, keypoints, rows);
  for (int row = 0; row < rows.rows; ++row) {
    std::memcpy(descriptors[keypoints[row].class_id].data(), rows.ptr(row), 32);
  }
  return descriptors;
}

std::vector<std::pair<int, int>> MatchDescriptors(const std::vector<CornerDescriptor>& a,
                                                  const std::vector<CornerDescriptor>& b) {
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> indices_a, indices_b;
  const cv::Mat rows_a = Rows(a, &indices_a);
  const cv::Mat rows_b = Rows(b, &indices_b);
  if (rows_a.empty() || rows_b.empty()) return pairs;
  const std::vector<int> there = Nearest(rows_a, rows_b);
  const std::vector<int> back = Nearest(rows_b, rows_a);
  for (int row = 0; row < rows_a.rows; ++row) {
    const int other = there[row];
    if (other >= 0 && back[other] == row) pairs.emplace_back(indices_a[row], indices_b[other]);
  }
  return pairs;
}

}  // namespace ceres_ed
