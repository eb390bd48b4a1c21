// Makes pages and pictures of runs that have ended.
#ifndef CERES_ED_PIPELINE_REPORT_REPORT_RUN_H_
#define CERES_ED_PIPELINE_REPORT_REPORT_RUN_H_

#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/report/report_settings.h>
#include <ceres_ed/pipeline/run_observer.h>

namespace ceres_ed {

// Reads the reports of the runs and the files that they name, and writes page and picture. Files
// that are missing are named in warnings and on the page, which goes on without them. Returns how
// the run ended.
Outcome RunReport(const ReportSettings& settings, RunObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_REPORT_REPORT_RUN_H_
