#include "ceres_ed/pipeline/apply/field_settings.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/util/options.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <thread>
#include <vector>

namespace ceres_ed {

const OptionTable<FieldSettings>& FieldSettings::Rows() {
  using S = FieldSettings;
  static const OptionTable<S> rows({
      Row(&S::field,
          "field",
          "Displacement field to write, for other tools: .nrrd .nii .nii.gz .mha .mhd .h5 .vti. It "
          "moves points of SOURCE onto TARGET.")
          .File(),
      Row(&S::rigid,
          "rigid",
          "Rigid placement to write: a 4 x 4 matrix in text that moves SOURCE, or a .tfm that "
          "resamples, for ITK.")
          .File(),
      Row(&S::inverse, "inverse", "The field maps TARGET to SOURCE, as resampling wants it.")
          .Main(),
      Row(&S::spacing,
          "spacing",
          "The distance of the field's points, in the unit of SOURCE (of TARGET, if inverse).")
          .In(AtLeast(0))
          .Special(0, "auto")
          .Main(),
      Row(&S::frame,
          "frame",
          "What the axes of the surfaces are: left-posterior-superior or right-anterior-superior. "
          "The medical formats are written as LPS.")
          .Main(),
      Row(&S::unit, "unit", "The unit of the surfaces; the medical formats are written in mm.")
          .Main(),
      Row(&S::margin, "margin", "How far the grid reaches beyond the surface.")
          .In(AtLeast(0))
          .Unit("node spacings")
          .Main(),
      Row(&S::bounds, "bounds", "The box of the grid instead: x0,x1,y0,y1,z0,z1.").Main(),
      Row(&S::like, "like", "Image (.nrrd .nii .nii.gz .mha .mhd) whose grid is used instead.")
          .File(),
      Row(&S::no_inverse, "no_inverse", "The displacement where the warp has no inverse.").Main(),
      Row(&S::max_mb, "max_mb", "The largest field that is made, before compression.")
          .In(Above(0))
          .Unit("MB")
          .Main(),
      Row(&S::num_threads, "threads", "The threads; the result does not depend on them.")
          .In(AtLeast(1))
          .Special(0, std::max(1u, std::thread::hardware_concurrency()), "auto")
          .Main(),
  });
  return rows;
}

StatusOr<std::optional<Eigen::AlignedBox3d>> ParseBounds(const std::string& bounds) {
  if (bounds.empty()) return std::optional<Eigen::AlignedBox3d>();
  const Status bad = Status::Error("--bounds=" + Quoted(bounds) +
                                   ", expected x0,x1,y0,y1,z0,z1: six finite numbers with x0 <= "
                                   "x1, y0 <= y1, z0 <= z1");
  std::vector<double> numbers;
  for (const std::string_view field : SplitFields(bounds, ',')) {
    const std::optional<double> number = ParseDouble(Trim(field));
    if (!number.has_value() || !std::isfinite(*number)) return bad;
    numbers.push_back(*number);
  }
  if (numbers.size() != 6) return bad;
  Eigen::AlignedBox3d box;
  for (int axis = 0; axis < 3; ++axis) {
    if (numbers[2 * axis] > numbers[2 * axis + 1]) return bad;
    box.min()[axis] = numbers[2 * axis];
    box.max()[axis] = numbers[2 * axis + 1];
  }
  return std::optional<Eigen::AlignedBox3d>(box);
}

}  // namespace ceres_ed
