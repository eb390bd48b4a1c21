// JSON reports of runs.
#ifndef CERES_ED_PIPELINE_REPORT_H_
#define CERES_ED_PIPELINE_REPORT_H_

#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/util/status.h>

#include <string>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Writes `report` under a temporary name and renames it to `path`. NaN and infinity, which JSON
// lacks, become null, and bytes of a path that are no UTF-8 become U+FFFD. Error: names the path.
Status WriteReport(const std::string& path, const nlohmann::ordered_json& report);

// Returns each flag by its name, with a value of its type: the "flags" of a report.
nlohmann::ordered_json FlagsReport(const RunFlags& flags);

// Returns {"ceres", "sparse_library", "ordering_library", "blas", "kernels"}: the "backend" of a
// report.
nlohmann::ordered_json BackendReport();

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_REPORT_H_
