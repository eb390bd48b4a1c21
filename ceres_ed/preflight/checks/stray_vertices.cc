#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/stray_points.h>

namespace ceres_ed {

void CheckStrayVertices(const Specimen& specimen, std::vector<Finding>* findings) {
  const auto add = [&](const char* code, std::size_t count, const std::string& what) {
    if (count == 0) return;
    findings->push_back({code,
                         Severity::kNote,
                         specimen.name + ": " + std::to_string(count) + " of " +
                             std::to_string(specimen.cloud->size()) + " vertices " + what,
                         "a fit leaves them out; delete them",
                         static_cast<double>(count)});
  };
  add("vertices_at_origin",
      UnmeasuredPoints(*specimen.cloud).size(),
      "are at 0 0 0 and were probably not measured");
  add("far_vertices", FarPoints(*specimen.cloud).size(), "are far from all others");
}

}  // namespace ceres_ed
