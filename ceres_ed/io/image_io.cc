#include "ceres_ed/io/image_io.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/picture_header.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace ceres_ed {
namespace {

// Returns an error for a PNG that is cut off: libpng would write to stderr on its own. Its chunks
// (length, type, data, checksum) must end with IEND.
Status CheckWholePng(const std::string& path, std::string_view bytes) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::size_t kAroundData = 12;
  if (bytes.substr(0, kSignature.size()) != kSignature) return Status::Ok();
  std::size_t at = kSignature.size();
  while (bytes.size() - at >= kAroundData) {
    std::size_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    if (bytes.size() - at - kAroundData < length) break;
    if (bytes.substr(at + 4, 4) == "IEND") return Status::Ok();
    at += kAroundData + length;
  }
  return Status::Error(path + ": a PNG that ends after " + std::to_string(bytes.size()) +
                       " bytes, before its last chunk (IEND): it was not written whole");
}

// Returns one line: OpenCV's messages have several.
std::string OneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  return text;
}

StatusOr<cv::Mat> Decode(const std::string& path, int flags) {
  // The file is read first, since OpenCV gives the reason why a file can't be opened only on
  // stderr.
  const StatusOr<std::string> bytes = ReadWholeFile(path);
  if (!bytes.ok()) return bytes.status();
  if (bytes->empty()) return Status::Error(path + ": empty, expected a PNG or JPEG");
  if (Status status = CheckWholePng(path, *bytes); !status.ok()) return status;
  if (Status status = CheckPictureHeader(path, *bytes); !status.ok()) return status;
  if (bytes->size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return Status::Error(path + ": " + std::to_string(bytes->size()) +
                         " bytes, expected less than 2 GiB");
  }
  const cv::Mat encoded(
      1, static_cast<int>(bytes->size()), CV_8UC1, const_cast<char*>(bytes->data()));
  cv::Mat image;
  try {
    image = cv::imdecode(encoded, flags);
  } catch (const std::exception& error) {
    return Status::Error(path + ": can't be decoded: " + OneLine(error.what()));
  }
  if (image.empty())
    return Status::Error(path + ": no picture that can be read, expected a PNG, JPEG or TIFF");
  return image;
}

bool EndsWith(const std::string& text, std::string_view end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

Status Encode(const std::string& path, const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  const bool is_tiff = EndsWith(path, ".tiff");
  const char* const kind = is_tiff ? ".tiff" : ".png";
  // Otherwise OpenCV would round floats to the few digits of SGI LogLuv.
  constexpr int kUncompressed = 1;
  std::vector<int> options;
  if (is_tiff) options = {cv::IMWRITE_TIFF_COMPRESSION, kUncompressed};
  if (!cv::imencode(kind, image, bytes, options)) {
    return Status::Error(path + ": can't be encoded as " + (kind + 1));
  }
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

// Returns the metres of channel `channel` of an image of floats.
DepthImage FloatsToMetres(const cv::Mat& image, int channel, double units_per_metre) {
  DepthImage depth(image.cols, image.rows, 0.0F);
  for (int v = 0; v < image.rows; ++v) {
    const float* row = image.ptr<float>(v);
    for (int u = 0; u < image.cols; ++u) {
      const float stored = row[image.channels() * u + channel];
      const bool is_depth = std::isfinite(stored) && stored > 0.0F;
      if (is_depth) depth(u, v) = static_cast<float>(static_cast<double>(stored) / units_per_metre);
    }
  }
  return depth;
}

StatusOr<DepthImage> ReadDepthArray(const std::string& path, double units_per_metre) {
  const StatusOr<NpyArray> array = ReadNpyFile(path);
  if (!array.ok()) return array.status();
  constexpr std::size_t kLargest = 32768;
  std::vector<std::size_t> shape = array->shape;
  if (shape.size() == 3 && shape[2] == 1) shape.pop_back();
  const bool is_picture = shape.size() == 2 && std::all_of(shape.begin(), shape.end(), [](auto n) {
                            return n > 0 && n <= kLargest;
                          });
  if (!is_picture) {
    return Status::Error(path + ": the shape is " + array->ShapeText() +
                         ", expected depth as (height, width)");
  }
  DepthImage depth(static_cast<int>(shape[1]), static_cast<int>(shape[0]), 0.0F);
  std::transform(array->values.begin(),
                 array->values.end(),
                 depth.pixels().begin(),
                 [units_per_metre](double stored) {
                   const bool is_depth = std::isfinite(stored) && stored > 0.0;
                   return is_depth ? static_cast<float>(stored / units_per_metre) : 0.0F;
                 });
  return depth;
}

}  // namespace

StatusOr<DepthImage> ReadDepthImage(const std::string& path,
                                    double units_per_metre,
                                    int* saturated) {
  CHECK_GT(units_per_metre, 0.0);
  if (saturated != nullptr) *saturated = 0;
  if (EndsWith(path, ".npy")) return ReadDepthArray(path, units_per_metre);
  StatusOr<cv::Mat> image = Decode(path, cv::IMREAD_UNCHANGED);
  if (!image.ok()) return image.status();
  if (image->type() == CV_16UC1) {
    const int count = RemoveSaturated(&*image);
    if (saturated != nullptr) *saturated = count;
    return ToMetres<std::uint16_t>(*image, units_per_metre);
  }
  if (image->type() == CV_32FC1) return FloatsToMetres(*image, 0, units_per_metre);
  // x, y, z are the red, green and blue of the file, and OpenCV turns them round.
  if (image->type() == CV_32FC3) return FloatsToMetres(*image, 0, units_per_metre);
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

Status WritePointImage(const std::string& path,
                       const PinholeCamera& camera,
                       const DepthImage& depth,
                       double units_per_metre) {
  CHECK_GT(units_per_metre, 0.0);
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  cv::Mat image(depth.height(), depth.width(), CV_32FC3, cv::Scalar::all(kNone));
  for (int v = 0; v < image.rows; ++v) {
    float* row = image.ptr<float>(v);
    for (int u = 0; u < image.cols; ++u) {
      if (!(depth(u, v) > 0.0F)) continue;
      const Eigen::Vector3d point = camera.BackProject(u, v, depth(u, v)) * units_per_metre;
      for (int axis = 0; axis < 3; ++axis) row[3 * u + 2 - axis] = static_cast<float>(point[axis]);
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
