// Looks at the clouds of files before a fit.
#ifndef CERES_ED_PIPELINE_CHECK_CHECK_FILES_H_
#define CERES_ED_PIPELINE_CHECK_CHECK_FILES_H_

#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/preflight/finding.h>

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// A cloud, which is not null, and the document from which it was read; null if its positions were
// doubles from the start.
struct CheckedFile {
  // The noun of the findings.
  std::string path;
  const PointCloud* cloud = nullptr;
  const PlyDocument* document = nullptr;
};

// Returns the findings about the source, about the target (whose path is empty if there is none),
// and about both. If `should_stop` returns true, the checks that are left are not made.
std::vector<Finding> CheckFiles(const CheckedFile& source,
                                const CheckedFile& target,
                                const std::function<bool()>& should_stop = {});

// Returns the findings as report.json has them.
nlohmann::ordered_json ChecksReport(const std::vector<Finding>& findings);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_CHECK_CHECK_FILES_H_
