#include "ceres_ed/io/image_io.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace ceres_ed {
namespace {

StatusOr<cv::Mat> Decode(const std::string& path, int flags) {
  // The file is read first, since OpenCV gives the reason why a file can't be opened only on
  // stderr.
  const StatusOr<std::string> bytes = ReadWholeFile(path);
  if (!bytes.ok()) return bytes.status();
  if (bytes->empty()) return Status::Error(path + ": empty, expected a PNG or JPEG");
  const cv::Mat encoded(
      1, static_cast<int>(bytes->size()), CV_8UC1, const_cast<char*>(bytes->data()));
  cv::Mat image;
  try {
    image = cv::imdecode(encoded, flags);
  } catch (const std::exception& error) {
    return Status::Error(path + ": can't be decoded: " + error.what());
  }
  if (image.empty()) return Status::Error(path + ": no picture that can be read (PNG or JPEG)");
  return image;
}

Status Encode(const std::string& path, const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", image, bytes)) return Status::Error(path + ": can't be encoded as PNG");
  return WriteFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// The largest depth that a picture of 16 bits can hold: the number above it marks a pixel that is
// too far or was not measured.
constexpr std::uint16_t kSaturated = std::numeric_limits<std::uint16_t>::max();
constexpr double kLargestDepth = kSaturated - 1.0;

// Sets saturated pixels to 0, and returns their number.
int RemoveSaturated(cv::Mat* image) {
  int count = 0;
  for (int v = 0; v < image->rows; ++v) {
    std::uint16_t* row = image->ptr<std::uint16_t>(v);
    for (int u = 0; u < image->cols; ++u) {
      if (row[u] != kSaturated) continue;
      row[u] = 0;
      ++count;
    }
  }
  return count;
}

template <typename Stored>
DepthImage ToMetres(const cv::Mat& image, double units_per_metre) {
  DepthImage depth(image.cols, image.rows, 0.0F);
  for (int v = 0; v < image.rows; ++v) {
    const Stored* row = image.ptr<Stored>(v);
    for (int u = 0; u < image.cols; ++u) {
      depth(u, v) = static_cast<float>(static_cast<double>(row[u]) / units_per_metre);
    }
  }
  return depth;
}

}  // namespace

StatusOr<DepthImage> ReadDepthImage(const std::string& path,
                                    double units_per_metre,
                                    int* saturated) {
  CHECK_GT(units_per_metre, 0.0);
  if (saturated != nullptr) *saturated = 0;
  StatusOr<cv::Mat> image = Decode(path, cv::IMREAD_UNCHANGED);
  if (!image.ok()) return image.status();
  if (image->type() == CV_16UC1) {
    const int count = RemoveSaturated(&*image);
    if (saturated != nullptr) *saturated = count;
    return ToMetres<std::uint16_t>(*image, units_per_metre);
  }
  if (image->type() == CV_8UC1) return ToMetres<std::uint8_t>(*image, units_per_metre);
  return Status::Error(path + ": " + std::to_string(image->channels()) + " channels of " +
                       std::to_string(8 * image->elemSize1()) +
                       " bits, expected depth as one channel of 16 bits");
}

StatusOr<ColorImage> ReadColorImage(const std::string& path) {
  const StatusOr<cv::Mat> image = Decode(path, cv::IMREAD_COLOR);
  if (!image.ok()) return image.status();
  ColorImage color(image->cols, image->rows);
  for (int v = 0; v < image->rows; ++v) {
    const std::uint8_t* row = image->ptr<std::uint8_t>(v);
    for (int u = 0; u < image->cols; ++u) {
      color(u, v) = {row[3 * u + 2], row[3 * u + 1], row[3 * u]};
    }
  }
  return color;
}

StatusOr<MaskImage> ReadMaskImage(const std::string& path) {
  const StatusOr<cv::Mat> image = Decode(path, cv::IMREAD_COLOR);
  if (!image.ok()) return image.status();
  MaskImage mask(image->cols, image->rows);
  for (int v = 0; v < image->rows; ++v) {
    const std::uint8_t* row = image->ptr<std::uint8_t>(v);
    for (int u = 0; u < image->cols; ++u) {
      mask(u, v) = (row[3 * u] | row[3 * u + 1] | row[3 * u + 2]) != 0 ? 1 : 0;
    }
  }
  return mask;
}

Status WriteDepthImage(const std::string& path, const DepthImage& depth, double units_per_metre) {
  CHECK_GT(units_per_metre, 0.0);
  cv::Mat image(depth.height(), depth.width(), CV_16UC1);
  for (int v = 0; v < image.rows; ++v) {
    std::uint16_t* row = image.ptr<std::uint16_t>(v);
    for (int u = 0; u < image.cols; ++u) {
      const double units = std::round(static_cast<double>(depth(u, v)) * units_per_metre);
      const bool fits = units > 0.0 && units <= kLargestDepth;
      row[u] = fits ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
    }
  }
  return Encode(path, image);
}

Status WriteColorImage(const std::string& path, const ColorImage& color) {
  cv::Mat image(color.height(), color.width(), CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    std::uint8_t* row = image.ptr<std::uint8_t>(v);
    for (int u = 0; u < image.cols; ++u) {
      const auto& rgb = color(u, v);
      std::copy(rgb.rbegin(), rgb.rend(), row + 3 * u);
    }
  }
  return Encode(path, image);
}

Status WriteMaskImage(const std::string& path, const MaskImage& mask) {
  cv::Mat image(mask.height(), mask.width(), CV_8UC1);
  for (int v = 0; v < image.rows; ++v) {
    std::uint8_t* row = image.ptr<std::uint8_t>(v);
    for (int u = 0; u < image.cols; ++u) row[u] = mask(u, v) != 0 ? 255 : 0;
  }
  return Encode(path, image);
}

}  // namespace ceres_ed
