#include "ceres_ed/stereo/disparity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace ceres_ed {
namespace {

// OpenCV's steps of a pixel.
constexpr int kSteps = cv::StereoMatcher::DISP_SCALE;
// The number of disparities must be a multiple of this.
constexpr int kBlock = 16;
// The width of the small copy in which the range is found.
constexpr int kSmallWidth = 160;

template <typename Pixel>
cv::Mat Wrap(const Image<Pixel>& image, int type) {
  return {image.height(), image.width(), type, const_cast<Pixel*>(image.pixels().data())};
}

int ModeOf(StereoMode mode) {
  switch (mode) {
    case StereoMode::kSgbm:
      return cv::StereoSGBM::MODE_SGBM;
    case StereoMode::kHh:
      return cv::StereoSGBM::MODE_HH;
    case StereoMode::kThreeWay:
      return cv::StereoSGBM::MODE_SGBM_3WAY;
    case StereoMode::kHh4:
      return cv::StereoSGBM::MODE_HH4;
  }
  return cv::StereoSGBM::MODE_SGBM;
}

// Copies a picture into a wider one, `shift` columns to the right. The columns at the sides repeat
// the first and the last one.
cv::Mat Shifted(const cv::Mat& image, int shift, int width) {
  const int first = std::max(0, -shift);
  const int last = std::min(image.cols, width - shift);
  cv::Mat wide;
  if (first >= last) return cv::Mat(image.rows, width, image.type(), cv::Scalar(0));
  cv::copyMakeBorder(image.colRange(first, last),
                     wide,
                     0,
                     0,
                     std::max(0, shift),
                     width - std::max(0, shift) - (last - first),
                     cv::BORDER_REPLICATE);
  return wide;
}

// Returns the element of that rank.
double Quantile(std::vector<float>* values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), values->begin() + rank, values->end());
  return static_cast<double>((*values)[static_cast<std::size_t>(rank)]);
}

}  // namespace

DisparityImage MatchRows(const GrayImage& left,
                         const GrayImage& right,
                         const DisparityRange& range,
                         const StereoOptions& options) {
  const int width = left.width();
  const int count = (range.count + kBlock - 1) / kBlock * kBlock;
  // OpenCV gives no disparity to the first `min + count` columns. Therefore the pictures get
  // `count` more columns on the left, and the right one is moved so that the search begins at 0.
  const cv::Mat wide_left = Shifted(Wrap(left, CV_8UC1), count, width + count);
  const cv::Mat wide_right = Shifted(Wrap(right, CV_8UC1), count + range.min, width + count);
  const int area = options.window * options.window;
  const cv::Ptr<cv::StereoSGBM> matcher = cv::StereoSGBM::create(/*minDisparity=*/0,
                                                                 count,
                                                                 options.window,
                                                                 /*P1=*/8 * area,
                                                                 /*P2=*/32 * area,
                                                                 options.left_right,
                                                                 /*preFilterCap=*/31,
                                                                 options.uniqueness,
                                                                 /*speckleWindowSize=*/0,
                                                                 /*speckleRange=*/0,
                                                                 ModeOf(options.mode));
  cv::Mat found;
  matcher->compute(wide_left, wide_right, found);
  // Matches outside of the right picture come from the added columns.
  constexpr short kInvalid = -kSteps;
  cv::Mat part = found.colRange(count, count + width);
  for (int v = 0; v < part.rows; ++v) {
    short* const row = part.ptr<short>(v);
    for (int u = 0; u < width; ++u) {
      const double match = u - range.min - static_cast<double>(row[u]) / kSteps;
      if (row[u] < 0 || match < 0.0 || match > width - 1.0) row[u] = kInvalid;
    }
  }
  if (options.speckle_size > 0) {
    cv::filterSpeckles(part, kInvalid, options.speckle_size, kSteps);
  }
  DisparityImage disparity(width, left.height(), kNoDisparity);
  for (int v = 0; v < part.rows; ++v) {
    const short* const row = part.ptr<short>(v);
    for (int u = 0; u < width; ++u) {
      if (row[u] < 0) continue;
      disparity(u, v) = static_cast<float>(range.min) + static_cast<float>(row[u]) / kSteps;
    }
  }
  return disparity;
}

DisparityRange FindRange(const GrayImage& left,
                         const GrayImage& right,
                         const MaskImage& left_mask,
                         double offset) {
  const int scale = std::max(1, static_cast<int>(std::lround(1.0 * left.width() / kSmallWidth)));
  const int width = left.width() / scale, height = left.height() / scale;
  const auto reduce = [&](const GrayImage& image) {
    GrayImage small(width, height);
    cv::Mat target = Wrap(small, CV_8UC1);
    const cv::Mat whole = Wrap(image, CV_8UC1)(cv::Rect(0, 0, width * scale, height * scale));
    cv::resize(whole, target, target.size(), 0, 0, cv::INTER_AREA);
    return small;
  };
  StereoOptions options;
  options.mode = StereoMode::kSgbm;
  options.window = 5;
  options.uniqueness = 10;
  options.speckle_size = 30;
  const int infinity = static_cast<int>(std::floor(offset / scale));
  const DisparityImage small =
      MatchRows(reduce(left), reduce(right), {infinity, std::max(kBlock, width / 2)}, options);
  std::vector<float> found;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const float d = small(u, v);
      if (d == kNoDisparity || left_mask(u * scale + scale / 2, v * scale + scale / 2) == 0)
        continue;
      // What has no disparity is not tissue.
      if (static_cast<double>(d) * scale - offset > 1.0) found.push_back(d);
    }
  }
  constexpr double kFewest = 0.01;
  if (static_cast<double>(found.size()) < kFewest * width * height) return {};
  const double low = scale * Quantile(&found, 0.005);
  const double high = scale * Quantile(&found, 0.995);
  const double margin = std::max(4.0, 0.1 * (high - low)) + scale;
  const int min = static_cast<int>(std::floor(std::max(offset, low - margin)));
  const int max = static_cast<int>(std::ceil(high + margin));
  return {min, max - min + 1};
}

void RefineDisparity(const GrayImage& left, const GrayImage& right, DisparityImage* disparity) {
  constexpr int kRounds = 2;
  constexpr int kWindow = 9;
  // The least mean square of the gradient, in levels per pixel.
  constexpr float kLeastTexture = 1.0F;
  constexpr float kFarthest = 1.0F;
  const int width = left.width(), height = left.height();
  cv::Mat smooth_left, smooth_right, left_gradient, right_gradient;
  const cv::Size blur(3, 3);
  cv::GaussianBlur(Wrap(left, CV_8UC1), smooth_left, blur, 0.7);
  cv::GaussianBlur(Wrap(right, CV_8UC1), smooth_right, blur, 0.7);
  smooth_left.convertTo(smooth_left, CV_32F);
  smooth_right.convertTo(smooth_right, CV_32F);
  cv::Sobel(smooth_left, left_gradient, CV_32F, 1, 0, 1, 0.5);
  cv::Sobel(smooth_right, right_gradient, CV_32F, 1, 0, 1, 0.5);
  const DisparityImage given = *disparity;
  cv::Mat columns(height, width, CV_32F), rows(height, width, CV_32F);
  cv::Mat warped, warped_gradient;
  cv::Mat terms(height, width, CV_32FC(4)), counts(height, width, CV_32F), sums, numbers;
  for (int round = 0; round < kRounds; ++round) {
    // The right picture as the left camera would see it.
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const float d = (*disparity)(u, v);
        columns.at<float>(v, u) = d == kNoDisparity ? -1e4F : static_cast<float>(u) - d;
        rows.at<float>(v, u) = static_cast<float>(v);
      }
    }
    cv::remap(smooth_right, warped, columns, rows, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    cv::remap(right_gradient, warped_gradient, columns, rows, cv::INTER_LINEAR);
    for (int v = 0; v < height; ++v) {
      float* const term = terms.ptr<float>(v);
      for (int u = 0; u < width; ++u) {
        const bool known = (*disparity)(u, v) != kNoDisparity;
        const float g =
            known ? 0.5F * (left_gradient.at<float>(v, u) + warped_gradient.at<float>(v, u)) : 0.0F;
        const float e = known ? smooth_left.at<float>(v, u) - warped.at<float>(v, u) : 0.0F;
        term[4 * u] = g;
        term[4 * u + 1] = e;
        term[4 * u + 2] = g * g;
        term[4 * u + 3] = g * e;
        counts.at<float>(v, u) = known ? 1.0F : 0.0F;
      }
    }
    const cv::Size window(kWindow, kWindow);
    cv::boxFilter(terms, sums, CV_32F, window, cv::Point(-1, -1), false, cv::BORDER_CONSTANT);
    cv::boxFilter(counts, numbers, CV_32F, window, cv::Point(-1, -1), false, cv::BORDER_CONSTANT);
    for (int v = 0; v < height; ++v) {
      const float* const sum = sums.ptr<float>(v);
      for (int u = 0; u < width; ++u) {
        float& d = (*disparity)(u, v);
        const float n = numbers.at<float>(v, u);
        if (d == kNoDisparity || n < 0.5F * kWindow * kWindow) continue;
        const float* const s = sum + 4 * u;
        const float texture = s[2] - s[0] * s[0] / n;
        if (texture < kLeastTexture * n) continue;
        // L = R(u - d - s) = R(u - d) - s g, so that e = -s g + c.
        const float shift = -(s[3] - s[0] * s[1] / n) / texture;
        const float moved = d + std::clamp(shift, -0.5F, 0.5F);
        if (std::abs(moved - given(u, v)) <= kFarthest) d = moved;
      }
    }
  }
}

void SmoothDisparity(int radius, DisparityImage* disparity) {
  constexpr double kEdge = 1.0;
  cv::Mat smooth;
  // Unknown disparities are so far from all others that they have no weight; OpenCV tabulates the
  // weights over the whole range, so they must not be too far away.
  DisparityImage filled = *disparity;
  float lowest = std::numeric_limits<float>::max();
  for (const float d : filled.pixels()) {
    if (d != kNoDisparity) lowest = std::min(lowest, d);
  }
  for (float& d : filled.pixels()) {
    if (d == kNoDisparity) d = lowest - 20.0F;
  }
  cv::bilateralFilter(
      Wrap(filled, CV_32FC1), smooth, 2 * radius + 1, kEdge, 0.5 * radius, cv::BORDER_REPLICATE);
  for (int v = 0; v < smooth.rows; ++v) {
    for (int u = 0; u < smooth.cols; ++u) {
      float& d = (*disparity)(u, v);
      if (d != kNoDisparity) d = smooth.at<float>(v, u);
    }
  }
}

GrayImage HalfSize(const GrayImage& image) {
  GrayImage half(image.width() / 2, image.height() / 2);
  cv::Mat target = Wrap(half, CV_8UC1);
  const cv::Mat whole = Wrap(image, CV_8UC1)(cv::Rect(0, 0, 2 * half.width(), 2 * half.height()));
  cv::resize(whole, target, target.size(), 0, 0, cv::INTER_AREA);
  return half;
}

DisparityImage DoubleSize(const DisparityImage& half, int width, int height) {
  DisparityImage full(width, height, kNoDisparity);
  for (int v = 0; v < height; ++v) {
    // The centre of pixel v is at v / 2 - 1 / 4 in the small picture. Where the four pixels around
    // it are all known and close to each other they are interpolated.
    const double y = 0.5 * v - 0.25;
    const int v0 = std::clamp(static_cast<int>(std::floor(y)), 0, half.height() - 1);
    const int v1 = std::min(v0 + 1, half.height() - 1);
    const float b = static_cast<float>(std::clamp(y - v0, 0.0, 1.0));
    for (int u = 0; u < width; ++u) {
      const double x = 0.5 * u - 0.25;
      const int u0 = std::clamp(static_cast<int>(std::floor(x)), 0, half.width() - 1);
      const int u1 = std::min(u0 + 1, half.width() - 1);
      const float a = static_cast<float>(std::clamp(x - u0, 0.0, 1.0));
      const float d00 = half(u0, v0), d10 = half(u1, v0), d01 = half(u0, v1), d11 = half(u1, v1);
      const auto [low, high] = std::minmax({d00, d10, d01, d11});
      if (low != kNoDisparity && high - low <= 1.0F) {
        full(u, v) = 2.0F * ((1 - b) * ((1 - a) * d00 + a * d10) + b * ((1 - a) * d01 + a * d11));
      } else {
        const float nearest =
            half(std::min(u / 2, half.width() - 1), std::min(v / 2, half.height() - 1));
        if (nearest != kNoDisparity) full(u, v) = 2.0F * nearest;
      }
    }
  }
  return full;
}

void Shrink(int radius, MaskImage* mask) {
  cv::Mat image = Wrap(*mask, CV_8UC1);
  const cv::Mat square =
      cv::getStructuringElement(cv::MORPH_RECT, cv::Size(2 * radius + 1, 2 * radius + 1));
  cv::erode(image, image, square, cv::Point(-1, -1), 1, cv::BORDER_REPLICATE);
}

}  // namespace ceres_ed
