// JSON reports of runs.
#ifndef CERES_ED_PIPELINE_REPORT_H_
#define CERES_ED_PIPELINE_REPORT_H_

#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/util/status.h>

#include <string>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Writes `report` to a temporary file and renames it to `path`. NaN and infinity, which JSON does
// not have, become null, and bytes of a path that are not UTF-8 become U+FFFD. The error names the
// path.
Status WriteReport(const std::string& path, const nlohmann::ordered_json& report);

// Returns the "flags" of a report: each flag by its name, with a value of its type.
nlohmann::ordered_json FlagsReport(const RunFlags& flags);

// Returns the "backend" of a report: {"ceres", "sparse_library", "ordering_library", "blas",
// "kernels"}.
nlohmann::ordered_json BackendReport();

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_REPORT_H_
