#include "ceres_ed/io/sequence/layouts/stereo_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace ceres_ed {
namespace {

constexpr std::string_view kHeader = "fx fy cx_left cx_right cy width height baseline_metres";
constexpr std::size_t kNumFields = 8;
constexpr std::array<std::string_view, kNumFields> kFields = {
    "fx", "fy", "cx_left", "cx_right", "cy", "width", "height", "baseline_metres"};

// The largest width and height, as in camera.txt.
constexpr int kMaxSize = 32768;
// A baseline in millimetres is larger than this.
constexpr double kMaxBaseline = 1.0;

// Returns what is expected of field `index` if it can't have `value`, otherwise an empty string.
std::string Expectation(std::size_t index, double value) {
  const std::string_view name = kFields[index];
  if (name == "fx" || name == "fy") return value > 0.0 ? "" : "a focal length > 0 pixels";
  if (name == "baseline_metres") {
    return value > 0.0 && value <= kMaxBaseline ? "" : "metres, > 0 and at most 1 (0.005 is 5 mm)";
  }
  if (name != "width" && name != "height") return "";
  const bool is_size = value >= 1.0 && value <= kMaxSize && value == std::floor(value);
  return is_size ? "" : "a whole number of pixels from 1 to " + std::to_string(kMaxSize);
}

Status CheckField(const std::string& place,
                  std::size_t index,
                  double value,
                  std::string_view text) {
  const std::string expected = Expectation(index, value);
  if (expected.empty()) return Status::Ok();
  return Status::Error(place + std::string(kFields[index]) + " is " + Quoted(text) + ", expected " +
                       expected);
}

}  // namespace

StereoRig MakeRectifiedRig(const PinholeCamera& left, double cx_right, double baseline) {
  StereoRig rig;
  rig.left.pinhole = left;
  rig.right.pinhole = left;
  rig.right.pinhole.cx = cx_right;
  rig.right_from_left.translation = {-baseline, 0.0, 0.0};
  return rig;
}

StatusOr<StereoRig> ReadStereoFile(const std::string& path) {
  std::array<double, kNumFields> values{};
  std::size_t count = 0;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    for (const std::string_view field : row.fields) {
      if (count == kNumFields) {
        return Status::Error(row.place + Quoted(field) + " behind the eighth number, expected " +
                             "nothing more than " + std::string(kHeader));
      }
      const StatusOr<double> value = ParseFinite(row.place, kFields[count], field);
      if (!value.ok()) return value.status();
      Status in_range = CheckField(row.place, count, *value, field);
      if (!in_range.ok()) return in_range;
      values[count++] = *value;
    }
    return Status::Ok();
  });
  if (!status.ok()) return status;
  if (count != kNumFields) {
    return Status::Error(path + ": " + std::to_string(count) +
                         (count == 1 ? " number" : " numbers") +
                         ", expected 8: " + std::string(kHeader));
  }
  const PinholeCamera left{values[0],
                           values[1],
                           values[2],
                           values[4],
                           static_cast<int>(values[5]),
                           static_cast<int>(values[6])};
  return MakeRectifiedRig(left, values[3], values[7]);
}

Status WriteStereoFile(const std::string& path, const StereoRig& rig) {
  const PinholeCamera& left = rig.left.pinhole;
  const std::array<double, kNumFields> values = {left.fx,
                                                 left.fy,
                                                 left.cx,
                                                 rig.right.pinhole.cx,
                                                 left.cy,
                                                 static_cast<double>(left.width),
                                                 static_cast<double>(left.height),
                                                 -rig.right_from_left.translation.x()};
  std::string contents = "# " + std::string(kHeader) + "\n";
  for (std::size_t i = 0; i < kNumFields; ++i) {
    std::string text;
    AppendNumbers({values[i]}, &text);
    const StatusOr<double> finite = ParseFinite(path + ": ", kFields[i], text);
    if (!finite.ok()) return finite.status();
    Status in_range = CheckField(path + ": ", i, values[i], text);
    if (!in_range.ok()) return in_range;
    contents += text + (i + 1 == kNumFields ? "\n" : " ");
  }
  return WriteFileAtomically(path, contents);
}

}  // namespace ceres_ed
