// Numbers as text for the scripts of a page: little-endian bytes in base64.
#ifndef CERES_ED_REPORT_HTML_BASE64_H_
#define CERES_ED_REPORT_HTML_BASE64_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// Returns bytes in base64 with padding (RFC 4648, section 4).
std::string Base64(std::string_view bytes);

// Return the numbers of a list as little-endian integers of 16 or 32 bits, or as doubles, in
// base64.
std::string Base64OfUint16(const std::vector<std::uint16_t>& numbers);
std::string Base64OfUint32(const std::vector<std::uint32_t>& numbers);
std::string Base64OfDoubles(const std::vector<double>& numbers);

// The number of a value that is unknown.
inline constexpr std::uint16_t kUnknownStep = 65535;

// Returns each value as the nearest of 65535 steps 0, ..., 65534 from `low` to `high`. What is not
// finite is kUnknownStep, and values beyond the ends have their steps.
std::vector<std::uint16_t> Quantize(const std::vector<double>& values, double low, double high);

// Returns x, y, z of each point as 65536 steps along the sides of `box`.
std::vector<std::uint16_t> QuantizePoints(const std::vector<Eigen::Vector3d>& points,
                                          const Eigen::AlignedBox3d& box);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_BASE64_H_
