#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/preflight/compare_sizes.h>
#include <ceres_ed/util/options.h>

namespace ceres_ed {

void CheckUnits(const Specimen& source, const Specimen& target, std::vector<Finding>* findings) {
  const std::optional<SizeMismatch> mismatch = CompareSizes(
      {source.name, Diagonal(source.cloud->points)}, {target.name, Diagonal(target.cloud->points)});
  if (!mismatch.has_value()) return;
  const std::string fix = mismatch->unit.has_value()
                              ? "use --scale=" + NumberText(*mismatch->unit) + " or --scale=auto"
                              : "use --scale=auto if the units differ";
  findings->push_back({"units", Severity::kWarning, mismatch->text, fix, mismatch->ratio});
}

}  // namespace ceres_ed
