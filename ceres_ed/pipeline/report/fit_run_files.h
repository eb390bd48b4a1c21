// The files of a fit that has ended, as there is to see of them.
#ifndef CERES_ED_PIPELINE_REPORT_FIT_RUN_FILES_H_
#define CERES_ED_PIPELINE_REPORT_FIT_RUN_FILES_H_

#include <ceres_ed/pipeline/report/run_reader.h>
#include <ceres_ed/report/view/fit_view.h>

#include <string>
#include <vector>

namespace ceres_ed {

struct FitRunView {
  FitView view;
  // A sentence for each file that is missing or cannot be used; the scene has them as notes.
  std::vector<std::string> missing;
};

// Reads source, target, result, warp, graph and landmarks of a run of ed_fit or ed_eval, as far as
// they are there, and the truth in the file `truth` (empty: that of the report, if it names one).
FitRunView ReadFitRun(const FinishedRun& run, const std::string& truth);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_REPORT_FIT_RUN_FILES_H_
