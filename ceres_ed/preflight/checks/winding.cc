#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/orientation.h>

namespace ceres_ed {

void CheckWinding(const Specimen& specimen, std::vector<Finding>* findings) {
  if (!specimen.cloud->HasTriangles()) return;
  const std::size_t against = TrianglesAgainstNeighbors(*specimen.cloud, *specimen.topology).size();
  if (against > 0) {
    findings->push_back({"winding",
                         Severity::kNote,
                         specimen.name + ": " + std::to_string(against) + " of " +
                             std::to_string(specimen.cloud->triangles.size()) +
                             " triangles are wound against their neighbours",
                         "a fit reverses them; make the winding consistent",
                         static_cast<double>(against)});
  }
  if (against == 0 && EnclosedVolume(*specimen.cloud, *specimen.topology) < 0.0) {
    findings->push_back({"inside_out",
                         Severity::kNote,
                         specimen.name + ": the closed surface is wound inside out",
                         "a fit finds the side by itself; reverse the triangles",
                         1.0});
  }
}

}  // namespace ceres_ed
