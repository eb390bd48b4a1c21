#include "ceres_ed/slam/frame/pixel_tracker.h"

#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glog/logging.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace ceres_ed {
namespace {

using Pyramid = std::vector<cv::Mat>;

std::vector<cv::Point2f> ToCv(const std::vector<Eigen::Vector2d>& pixels) {
  std::vector<cv::Point2f> points;
  points.reserve(pixels.size());
  for (const Eigen::Vector2d& p : pixels) {
    points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  return points;
}

// Returns the picture without the illumination. Lamps move with the camera, and a brightness
// gradient that is fixed in the picture would hold corners back. The logarithm turns illumination
// into an offset, which a high-pass filter removes; the remaining image is scaled to the same
// contrast everywhere. Mean and contrast are those of the pixels where `measured` is 1 (empty:
// all): otherwise the rim of an organ would shade the tissue beside it, and the shade moves with
// the rim. Other pixels count for themselves alone, so that they are never stronger than the
// tissue.
cv::Mat Flatten(const cv::Mat& rgb, const cv::Mat& measured, double radius) {
  constexpr double kLeastContrast = 0.03;
  constexpr double kGain = 40.0;
  cv::Mat gray, log, mean, square, deviation, flat;
  cv::cvtColor(rgb, gray, cv::COLOR_RGB2GRAY);
  gray.convertTo(log, CV_32F, 1.0, 8.0);
  cv::log(log, log);
  if (measured.empty()) {
    cv::GaussianBlur(log, mean, cv::Size(), radius);
    log -= mean;
    cv::GaussianBlur(log.mul(log), square, cv::Size(), radius);
  } else {
    cv::Mat share;
    cv::GaussianBlur(measured, share, cv::Size(), radius);
    // Far from what was measured a pixel is its own mean.
    constexpr double kLeastShare = 1e-3;
    cv::GaussianBlur(log.mul(measured), mean, cv::Size(), radius);
    mean = (mean + kLeastShare * log) / (share + kLeastShare);
    log -= mean;
    const cv::Mat squares = log.mul(log);
    cv::GaussianBlur(squares.mul(measured), square, cv::Size(), radius);
    square /= share + kLeastShare;
    square += squares.mul(1.0 - measured);
  }
  cv::sqrt(square, deviation);
  cv::divide(log, deviation + kLeastContrast, log, kGain);
  log.convertTo(flat, CV_8U, 1.0, 128.0);
  return flat;
}

// Returns the indices of `count` of the corners, which are sorted by their strength, so that they
// cover the picture: the best corner of each cell of a grid comes before the second best of any.
// Corners that are `taken` are counted as better.
std::vector<std::size_t> SpreadOut(const std::vector<cv::Point2f>& corners,
                                   const std::vector<cv::Point2f>& taken,
                                   const cv::Size& size,
                                   int count) {
  constexpr int kCornersPerCell = 4;
  const double all = static_cast<double>(taken.size()) + count;
  const double side = std::max(1.0, std::sqrt(kCornersPerCell * size.area() / all));
  const int columns = static_cast<int>(size.width / side) + 1;
  const int rows = static_cast<int>(size.height / side) + 1;
  std::vector<int> ranks(static_cast<std::size_t>(columns) * rows, 0);
  const auto rank = [&](const cv::Point2f& p) {
    const int i = std::clamp(static_cast<int>(p.x / side), 0, columns - 1);
    const int j = std::clamp(static_cast<int>(p.y / side), 0, rows - 1);
    return ranks[static_cast<std::size_t>(j) * columns + i]++;
  };
  for (const cv::Point2f& p : taken) rank(p);
  std::vector<std::pair<int, std::size_t>> order;
  order.reserve(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) order.emplace_back(rank(corners[k]), k);
  std::sort(order.begin(), order.end());
  order.resize(std::min<std::size_t>(order.size(), count));
  std::vector<std::size_t> chosen;
  chosen.reserve(order.size());
  for (const auto& [unused, k] : order) chosen.push_back(k);
  return chosen;
}

}  // namespace

struct PixelTracker::Impl {
  PixelTrackerOptions options;
  cv::Mat gray;
  // At half the resolution.
  cv::Mat half;
  Pyramid before;
  Pyramid now;

  // Builds `half` and the pyramid of `gray`.
  void BuildPyramid() {
    cv::pyrDown(gray, half);
    now.clear();
    cv::buildOpticalFlowPyramid(
        gray, now, cv::Size(options.window, options.window), options.pyramid_levels);
  }

  // Corners are tracked independently, so parts of them run in parallel. `end` and `found` have the
  // size of `start`.
  void Flow(const Pyramid& from,
            const Pyramid& to,
            const std::vector<cv::Point2f>& start,
            std::vector<cv::Point2f>* end,
            std::vector<unsigned char>* found) const {
    const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01);
    const auto count = static_cast<int>(start.size());
    ParallelFor(options.num_threads, count, [&](int first, int last) {
      const cv::Range part(first, last);
      // These are views of the vectors' own memory; because their sizes are correct, OpenCV
      // allocates nothing.
      cv::Mat part_end = cv::Mat(*end).rowRange(part);
      cv::Mat part_found = cv::Mat(*found).rowRange(part);
      cv::calcOpticalFlowPyrLK(from,
                               to,
                               cv::Mat(start).rowRange(part),
                               part_end,
                               part_found,
                               cv::noArray(),
                               cv::Size(options.window, options.window),
                               options.pyramid_levels,
                               stop,
                               cv::OPTFLOW_USE_INITIAL_FLOW);
    });
  }
};

PixelTracker::PixelTracker(const PixelTrackerOptions& options) : impl_(new Impl) {
  impl_->options = options;
  // OpenCV uses one thread, so that the results have the same bytes on any machine.
  cv::setNumThreads(1);
}

PixelTracker::~PixelTracker() = default;

void PixelTracker::SetImage(ColorView image, const MaskImage& measured) {
  // OpenCV only reads this image.
  const cv::Mat rgb(image.height(),
                    image.width(),
                    CV_8UC3,
                    const_cast<void*>(static_cast<const void*>(image.pixels())));
  cv::Mat known;
  if (std::find(measured.pixels().begin(), measured.pixels().end(), 0) != measured.pixels().end()) {
    const cv::Mat mask(measured.height(),
                       measured.width(),
                       CV_8UC1,
                       const_cast<std::uint8_t*>(measured.pixels().data()));
    mask.convertTo(known, CV_32F);
  }
  impl_->gray = Flatten(rgb, known, impl_->options.light_radius);
  impl_->before = std::move(impl_->now);
  impl_->BuildPyramid();
}

void PixelTracker::ForgetPrevious() { impl_->before.clear(); }

GrayLevels PixelTracker::Levels() const {
  const auto view = [](const cv::Mat& image) {
    return ImageView<std::uint8_t>(image.ptr<std::uint8_t>(), image.cols, image.rows);
  };
  return {view(impl_->gray), view(impl_->half)};
}

std::vector<TrackedPixel> PixelTracker::Flow(const std::vector<Eigen::Vector2d>& pixels,
                                             const std::vector<Eigen::Vector2d>& predicted) const {
  CHECK_EQ(pixels.size(), predicted.size());
  std::vector<TrackedPixel> tracked(pixels.size());
  if (pixels.empty() || impl_->before.empty()) return tracked;
  const std::vector<cv::Point2f> start = ToCv(pixels);
  std::vector<cv::Point2f> end = ToCv(predicted);
  std::vector<unsigned char> found(start.size());
  impl_->Flow(impl_->before, impl_->now, start, &end, &found);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    tracked[i].pixel = {end[i].x, end[i].y};
    tracked[i].found = found[i] != 0 && tracked[i].pixel.allFinite();
  }
  return tracked;
}

void PixelTracker::CheckReturn(const std::vector<Eigen::Vector2d>& pixels,
                               const std::vector<Eigen::Vector2d>& predicted,
                               std::vector<TrackedPixel>* tracked) const {
  if (pixels.empty() || impl_->before.empty()) return;
  // The search backward starts from the same prediction, so that both directions have equally far
  // to search.
  const std::vector<cv::Point2f> start = ToCv(pixels);
  const std::vector<cv::Point2f> guess = ToCv(predicted);
  std::vector<cv::Point2f> end, back;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Eigen::Vector2d& pixel = (*tracked)[i].pixel;
    end.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
    back.push_back(end[i] - (guess[i] - start[i]));
  }
  std::vector<unsigned char> found(end.size());
  impl_->Flow(impl_->now, impl_->before, end, &back, &found);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double round_trip = std::hypot(back[i].x - start[i].x, back[i].y - start[i].y);
    (*tracked)[i].found = (*tracked)[i].found && found[i] != 0 && std::isfinite(round_trip) &&
                          round_trip <= impl_->options.max_round_trip;
  }
}

std::vector<Eigen::Vector2d> PixelTracker::Detect(const MaskImage& allowed,
                                                  const std::vector<Eigen::Vector2d>& taken,
                                                  int count) const {
  std::vector<Eigen::Vector2d> corners;
  if (count <= 0) return corners;
  cv::Mat mask(allowed.height(), allowed.width(), CV_8UC1);
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      mask.at<unsigned char>(v, u) = allowed(u, v) != 0 ? 255 : 0;
    }
  }
  const int radius = static_cast<int>(std::ceil(impl_->options.min_distance));
  for (const cv::Point2f& p : ToCv(taken)) {
    cv::circle(mask, cv::Point(cvRound(p.x), cvRound(p.y)), radius, cv::Scalar(0), cv::FILLED);
  }
  // All corners, the strongest first.
  std::vector<cv::Point2f> found;
  cv::goodFeaturesToTrack(impl_->gray,
                          found,
                          /*maxCorners=*/0,
                          impl_->options.quality,
                          impl_->options.min_distance,
                          mask);
  for (const std::size_t k : SpreadOut(found, ToCv(taken), mask.size(), count)) {
    corners.emplace_back(found[k].x, found[k].y);
  }
  return corners;
}

void PixelTracker::Exchange(CheckpointArchive* archive) {
  cv::Mat& gray = impl_->gray;
  int height = gray.rows;
  archive->Value("height", &height);
  std::vector<std::uint8_t> pixels;
  if (!gray.empty()) pixels.assign(gray.begin<std::uint8_t>(), gray.end<std::uint8_t>());
  archive->Array("pixels", &pixels);
  // Everything else is computed from the present picture; the previous picture is not used again.
  if (archive->saving() || height <= 0 || pixels.empty()) return;
  gray = cv::Mat(pixels, /*copyData=*/true).reshape(1, height);
  impl_->BuildPyramid();
}

}  // namespace ceres_ed
