#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/unit_ratio.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <sstream>

namespace ceres_ed {

void CheckUnits(const Specimen& source, const Specimen& target, std::vector<Finding>* findings) {
  const double from = Diagonal(source.cloud->points);
  const double to = Diagonal(target.cloud->points);
  if (!(from > 0.0) || !(to > 0.0)) return;
  const double ratio = to / from;
  if (std::max(ratio, 1.0 / ratio) <= kPlausibleSizeRatio) return;
  std::ostringstream text;
  text.precision(4);
  text << target.name << " is " << std::max(ratio, 1.0 / ratio) << " times as "
       << (ratio > 1.0 ? "large" : "small") << " as " << source.name << " (diagonals " << to
       << " and " << from << ")";
  const std::optional<double> unit = NearestUnitRatio(ratio);
  if (unit.has_value())
    text << ", as if their units differed by a factor of "
         << NumberText(std::max(*unit, 1.0 / *unit));
  findings->push_back({"units",
                       Severity::kWarning,
                       text.str(),
                       unit.has_value() ? "use --scale=" + NumberText(*unit) + " or --scale=auto"
                                        : "use --scale=auto if the units differ",
                       ratio});
}

}  // namespace ceres_ed
