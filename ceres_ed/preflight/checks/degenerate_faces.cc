#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/preflight/faulty_faces.h>

namespace ceres_ed {

void CheckDegenerateFaces(const Specimen& specimen, std::vector<Finding>* findings) {
  const std::size_t count = DegenerateFaces(*specimen.cloud).size();
  if (count == 0) return;
  findings->push_back({"degenerate_faces",
                       Severity::kNote,
                       specimen.name + ": " + std::to_string(count) + " of " +
                           std::to_string(specimen.cloud->triangles.size()) +
                           " triangles have no area",
                       "use --repair, or delete them",
                       static_cast<double>(count)});
}

}  // namespace ceres_ed
