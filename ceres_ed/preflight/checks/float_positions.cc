#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <limits>

namespace ceres_ed {
namespace {

// Steps between floats up to this share of an edge do no harm.
constexpr double kHarmlessShare = 0.01;

}  // namespace

void CheckFloatPositions(const Specimen& specimen, std::vector<Finding>* findings) {
  if (!specimen.has_float_positions) return;
  double largest = 0.0;
  for (const Eigen::Vector3d& point : specimen.cloud->points) {
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  }
  const double step = largest * static_cast<double>(std::numeric_limits<float>::epsilon());
  const double edge = MeanEdgeLength(*specimen.topology);
  const double detail = edge > 0.0 ? edge : 1e-3 * Diagonal(specimen.cloud->points);
  if (!(step > kHarmlessShare * detail)) return;
  findings->push_back({"float_positions",
                       Severity::kWarning,
                       specimen.name + ": coordinates up to " + NumberText(largest) +
                           " are stored as floats, which are " + NumberText(step) +
                           " apart there; the mean edge is " + NumberText(detail),
                       "store them as double, or move both surfaces to the origin first",
                       step / detail});
}

}  // namespace ceres_ed
