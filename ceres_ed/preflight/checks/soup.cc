#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/preflight/near_duplicates.h>

namespace ceres_ed {

void CheckSoup(const Specimen& specimen, std::vector<Finding>* findings) {
  const PointCloud& cloud = *specimen.cloud;
  if (!cloud.HasTriangles()) return;
  const std::size_t near = NearDuplicates(cloud, *specimen.topology).size();
  if (near > 0) {
    findings->push_back({"gaps",
                         Severity::kWarning,
                         specimen.name + ": " + std::to_string(near) +
                             " vertices at borders are nearly, not exactly, at the place of "
                             "another vertex, so that the surface is cut there",
                         "use --repair, or weld the vertices",
                         static_cast<double>(near)});
  }
  const auto positions = specimen.topology->walk_order.size();
  const double copies = static_cast<double>(cloud.size()) / static_cast<double>(positions);
  if (copies > 1.5) {
    findings->push_back({"soup",
                         Severity::kNote,
                         specimen.name + ": " + std::to_string(cloud.size()) + " vertices at " +
                             std::to_string(positions) + " places: the triangles are not welded",
                         "a fit takes equal positions for one vertex; weld them to save memory",
                         copies});
  }
}

}  // namespace ceres_ed
