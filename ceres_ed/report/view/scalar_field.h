// A figure for each point of a surface, with the range of its colours.
#ifndef CERES_ED_REPORT_VIEW_SCALAR_FIELD_H_
#define CERES_ED_REPORT_VIEW_SCALAR_FIELD_H_

#include <ceres_ed/report/view/color_map.h>

#include <string>
#include <vector>

namespace ceres_ed {

// The values that colours show, from `low` to `high`, and the smallest and largest value that there
// is. All are 0 if no value is known.
struct FieldRange {
  double low = 0.0;
  double high = 0.0;
  double min = 0.0;
  double max = 0.0;

  // Returns where `value` is between low and high: 0 to 1, beyond them for values outside.
  double PartOf(double value) const {
    return high > low ? (value - low) / (high - low) : (value > high ? 1.0 : 0.0);
  }
};

struct ScalarField {
  // A word for programs, in snake_case. Fields of several surfaces with the same key have the same
  // colours.
  std::string key;
  // What people read.
  std::string name;
  std::string unit;
  ColorScale scale = ColorScale::kMagnitude;
  // One value for each point; NaN where it is unknown. On a surface with moments there may be one
  // for each point and moment, ordered as PointMoments::places.
  std::vector<double> values;
  FieldRange range;
  // 1 for values that must not set the range of the colours, such as those of a part that the
  // target does not show; empty if all count.
  std::vector<char> aside;
  // Whether values aside are grey; otherwise they have the colours of the others.
  bool hides_aside = false;
};

// Returns what a legend says about the values aside, beginning with "; "; empty if there are none.
std::string AsideNote(const ScalarField& field);

// Returns the range of all finite values in `fields`, none of which is null. The largest 2 % do not
// stretch the colours: `high` is the 98th percentile of the values that count, of the absolute
// values for a signed field, whose range has 0 in its middle. A magnitude begins at 0. If no value
// counts, all do.
FieldRange RangeOfFields(const std::vector<const ScalarField*>& fields);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_SCALAR_FIELD_H_
