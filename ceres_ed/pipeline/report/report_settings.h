// The settings of a report about finished runs.
#ifndef CERES_ED_PIPELINE_REPORT_REPORT_SETTINGS_H_
#define CERES_ED_PIPELINE_REPORT_REPORT_SETTINGS_H_

#include <ceres_ed/report/picture/theme.h>

#include <string>
#include <vector>

namespace ceres_ed {

// A path is empty if the file is not given or not requested.
struct ReportSettings {
  // Files report.json, or folders that have one. Several are compared.
  std::vector<std::string> runs;
  // The true places of the points of a fit, in the order of its source.
  std::string truth;
  // The outputs.
  std::string html;
  std::string png;
  Theme theme = Theme::kLight;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_REPORT_REPORT_SETTINGS_H_
