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

// Returns a picture with less noise, in floats.
cv::Mat Smoothed(const GrayImage& image) {
  cv::Mat smooth;
  cv::GaussianBlur(Wrap(image, CV_8UC1), smooth, cv::Size(3, 3), 0.7);
  smooth.convertTo(smooth, CV_32F);
  return smooth;
}

// Returns the derivative along the row, per pixel.
cv::Mat RowGradient(const cv::Mat& image) {
  cv::Mat gradient;
  cv::Sobel(image, gradient, CV_32F, 1, 0, 1, 0.5);
  return gradient;
}

// Moments of g and e = L - R over the window of each pixel. R is the right picture as the left
// camera would see it, by the disparities; g is the mean of the gradient of both, or that of the
// left one. Pixels without a disparity do not count.
class WindowSums {
 public:
  struct Moments {
    float gg = 0.0F;
    float ge = 0.0F;
    float ee = 0.0F;
  };

  WindowSums(const cv::Mat& left,
             const cv::Mat& left_gradient,
             const cv::Mat& right,
             const cv::Mat& right_gradient,
             const DisparityImage& disparity,
             bool mean_of_gradients = true) {
    const int width = disparity.width(), height = disparity.height();
    cv::Mat columns(height, width, CV_32F), rows(height, width, CV_32F);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const float d = disparity(u, v);
        columns.at<float>(v, u) = d == kNoDisparity ? 0.0F : static_cast<float>(u) - d;
        rows.at<float>(v, u) = static_cast<float>(v);
      }
    }
    cv::Mat warped, gradient;
    cv::remap(right, warped, columns, rows, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    if (mean_of_gradients) {
      cv::remap(right_gradient, gradient, columns, rows, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      gradient = 0.5 * (gradient + left_gradient);
    } else {
      gradient = left_gradient;
    }
    cv::Mat first(height, width, CV_32FC3), second(height, width, CV_32FC3);
    for (int v = 0; v < height; ++v) {
      const float* const l = left.ptr<float>(v);
      const float* const r = warped.ptr<float>(v);
      const float* const slope = gradient.ptr<float>(v);
      float* const a = first.ptr<float>(v);
      float* const b = second.ptr<float>(v);
      for (int u = 0; u < width; ++u) {
        const float n = disparity(u, v) != kNoDisparity ? 1.0F : 0.0F;
        const float g = n * slope[u], e = n * (l[u] - r[u]);
        a[3 * u] = n;
        a[3 * u + 1] = g;
        a[3 * u + 2] = e;
        b[3 * u] = g * g;
        b[3 * u + 1] = g * e;
        b[3 * u + 2] = e * e;
      }
    }
    const cv::Size window(kWidth, kWidth);
    const cv::Point center(-1, -1);
    cv::boxFilter(first, first_, CV_32F, window, center, false, cv::BORDER_CONSTANT);
    cv::boxFilter(second, second_, CV_32F, window, center, false, cv::BORDER_CONSTANT);
  }

  // Returns whether at least half of the window counts.
  bool Has(int u, int v) const { return first_.ptr<float>(v)[3 * u] >= 0.5F * kWidth * kWidth; }

  // Returns the variances and the covariance over the window.
  Moments At(int u, int v) const {
    const float* const a = first_.ptr<float>(v) + 3 * u;
    const float* const b = second_.ptr<float>(v) + 3 * u;
    const float n = a[0], g = a[1] / n, e = a[2] / n;
    return {b[0] / n - g * g, b[1] / n - g * e, b[2] / n - e * e};
  }

 private:
  static constexpr int kWidth = 9;
  cv::Mat first_, second_;
};

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
  // The least variance of the gradient, in levels per pixel.
  constexpr float kLeastTexture = 1.0F;
  constexpr float kFarthest = 0.5F;
  constexpr float kLargestStep = 0.5F;
  const cv::Mat smooth_left = Smoothed(left), smooth_right = Smoothed(right);
  const cv::Mat left_gradient = RowGradient(smooth_left);
  const cv::Mat right_gradient = RowGradient(smooth_right);
  const DisparityImage given = *disparity;
  for (int round = 0; round < kRounds; ++round) {
    const WindowSums sums(smooth_left, left_gradient, smooth_right, right_gradient, *disparity);
    for (int v = 0; v < left.height(); ++v) {
      for (int u = 0; u < left.width(); ++u) {
        float& d = (*disparity)(u, v);
        if (d == kNoDisparity || !sums.Has(u, v)) continue;
        const WindowSums::Moments m = sums.At(u, v);
        if (m.gg < kLeastTexture) continue;
        // L = R(u - d - s) = R(u - d) - s g, so that e = L - R(u - d) = -s g + c.
        const float moved = d - std::clamp(m.ge / m.gg, -kLargestStep, kLargestStep);
        if (std::abs(moved - given(u, v)) <= kFarthest) d = moved;
      }
    }
  }
}

void LeaveOutUnlike(const GrayImage& left,
                    const GrayImage& right,
                    double least,
                    DisparityImage* disparity) {
  const cv::Mat smooth_left = Smoothed(left), smooth_right = Smoothed(right);
  // With the picture itself in place of the gradient, the moments are those of L and of L - R.
  const WindowSums sums(smooth_left,
                        smooth_left,
                        smooth_right,
                        smooth_right,
                        *disparity,
                        /*mean_of_gradients=*/false);
  const auto bound = static_cast<float>(least);
  for (int v = 0; v < left.height(); ++v) {
    for (int u = 0; u < left.width(); ++u) {
      float& d = (*disparity)(u, v);
      if (d == kNoDisparity) continue;
      if (!sums.Has(u, v)) {
        d = kNoDisparity;
        continue;
      }
      // cov(L, R) = var(L) - cov(L, L - R), var(R) = var(L) - 2 cov(L, L - R) + var(L - R).
      const WindowSums::Moments m = sums.At(u, v);
      const float covariance = m.gg - m.ge;
      const float product = m.gg * std::max(0.0F, m.gg - 2.0F * m.ge + m.ee);
      if (covariance < bound * std::sqrt(product) || product == 0.0F) d = kNoDisparity;
    }
  }
}

void LeaveOutEdges(int margin, DisparityImage* disparity) {
  constexpr float kJump = 3.0F;
  // Holes with fewer pixels than this are no edge.
  constexpr int kSmallHole = 400;
  const int width = disparity->width(), height = disparity->height();
  // Holes that are not small keep the value 0, all else is 255.
  cv::Mat inside(height, width, CV_16SC1);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      inside.at<short>(v, u) = (*disparity)(u, v) == kNoDisparity ? 0 : 255;
    }
  }
  cv::filterSpeckles(inside, 255, kSmallHole, 1);
  MaskImage kept(width, height, 255);
  const auto differ = [&](int u, int v, int other_u, int other_v) {
    const float a = (*disparity)(u, v), b = (*disparity)(other_u, other_v);
    return a != kNoDisparity && b != kNoDisparity && std::abs(a - b) > kJump;
  };
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool is_edge = inside.at<short>(v, u) == 0 ||
                           (u + 1 < width && differ(u, v, u + 1, v)) ||
                           (v + 1 < height && differ(u, v, u, v + 1));
      if (is_edge) kept(u, v) = 0;
    }
  }
  Shrink(margin, &kept);
  for (std::size_t i = 0; i < kept.pixels().size(); ++i) {
    if (kept.pixels()[i] == 0) disparity->pixels()[i] = kNoDisparity;
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
