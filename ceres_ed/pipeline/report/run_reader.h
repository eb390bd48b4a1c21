// Reads report.json of a finished run, and finds the files that it names.
#ifndef CERES_ED_PIPELINE_REPORT_RUN_READER_H_
#define CERES_ED_PIPELINE_REPORT_RUN_READER_H_

#include <ceres_ed/util/status.h>

#include <string>

#include <nlohmann/json.hpp>

namespace ceres_ed {

struct FinishedRun {
  // The path of its report.
  std::string path;
  nlohmann::ordered_json report;

  // Returns where a file that the report names is: as it is named, seen from the current folder, or
  // else seen from the folder of the report. Empty if `name` is empty; `name` itself if there is no
  // such file.
  std::string Find(const std::string& name) const;
};

// Reads a report, or the file report.json of a folder. The error names the file: it cannot be read,
// is no JSON, or is no report.
StatusOr<FinishedRun> ReadFinishedRun(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_REPORT_RUN_READER_H_
