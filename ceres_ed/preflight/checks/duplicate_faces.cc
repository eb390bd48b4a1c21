#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/preflight/faulty_faces.h>

namespace ceres_ed {

void CheckDuplicateFaces(const Specimen& specimen, std::vector<Finding>* findings) {
  const std::size_t count = DuplicateFaces(*specimen.cloud, *specimen.topology).size();
  if (count == 0) return;
  findings->push_back({"duplicate_faces",
                       Severity::kWarning,
                       specimen.name + ": " + std::to_string(count) + " of " +
                           std::to_string(specimen.cloud->triangles.size()) +
                           " triangles are there twice",
                       "use --repair, or delete them",
                       static_cast<double>(count)});
}

}  // namespace ceres_ed
