#include "ceres_ed/report/html/base64.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace ceres_ed {
namespace {

template <typename T, typename Number>
std::string LittleEndian(const std::vector<Number>& numbers) {
  std::string bytes;
  bytes.reserve(numbers.size() * sizeof(T));
  for (const Number number : numbers) {
    T bits;
    static_assert(sizeof(T) == sizeof(Number), "the same bits");
    std::memcpy(&bits, &number, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes += static_cast<char>((bits >> (8 * i)) & 0xFFU);
    }
  }
  return bytes;
}

}  // namespace

std::string Base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = (bits << 8U) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[(bits >> (18U - 6U * k)) & 63U] : '=';
    }
  }
  return text;
}

std::string Base64OfUint16(const std::vector<std::uint16_t>& numbers) {
  return Base64(LittleEndian<std::uint16_t>(numbers));
}

std::string Base64OfUint32(const std::vector<std::uint32_t>& numbers) {
  return Base64(LittleEndian<std::uint32_t>(numbers));
}

std::string Base64OfDoubles(const std::vector<double>& numbers) {
  return Base64(LittleEndian<std::uint64_t>(numbers));
}

std::vector<std::uint16_t> Quantize(const std::vector<double>& values, double low, double high) {
  constexpr double kSteps = 65534.0;
  std::vector<std::uint16_t> steps;
  steps.reserve(values.size());
  for (const double value : values) {
    if (!std::isfinite(value)) {
      steps.push_back(kUnknownStep);
      continue;
    }
    const double part = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0;
    steps.push_back(static_cast<std::uint16_t>(std::lround(kSteps * part)));
  }
  return steps;
}

std::vector<std::uint16_t> QuantizePoints(const std::vector<Eigen::Vector3d>& points,
                                          const Eigen::AlignedBox3d& box) {
  constexpr double kSteps = 65535.0;
  std::vector<std::uint16_t> steps;
  steps.reserve(3 * points.size());
  for (const Eigen::Vector3d& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double side = box.max()[axis] - box.min()[axis];
      const double part = side > 0.0 ? (point[axis] - box.min()[axis]) / side : 0.0;
      steps.push_back(static_cast<std::uint16_t>(std::lround(kSteps * std::clamp(part, 0.0, 1.0))));
    }
  }
  return steps;
}

}  // namespace ceres_ed
