// What there is to look at of a fit that has just run: its page.
#ifndef CERES_ED_PIPELINE_FIT_FIT_PICTURE_H_
#define CERES_ED_PIPELINE_FIT_FIT_PICTURE_H_

#include <ceres_ed/pipeline/fit/fit_run.h>
#include <ceres_ed/util/status.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Writes the page of a usable fit to settings.html, if it is requested. `report` is FitReport() of
// the run. Each file is written atomically.
Status WriteFitPictures(const FitRun& run, const nlohmann::ordered_json& report);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_PICTURE_H_
