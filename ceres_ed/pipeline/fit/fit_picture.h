// What there is to look at of a fit that has just run: its page and its picture.
#ifndef CERES_ED_PIPELINE_FIT_FIT_PICTURE_H_
#define CERES_ED_PIPELINE_FIT_FIT_PICTURE_H_

#include <ceres_ed/pipeline/fit/fit_run.h>
#include <ceres_ed/report/view/fit_view.h>
#include <ceres_ed/util/status.h>

#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns what there is to see of a fit. `rows` has the rows of the source's points in its file; if
// it is empty, these are the indices. The arguments must outlive what is returned.
FitParts PartsOfFit(const FitInput& input, const FitResult& result, const std::vector<int>& rows);

// Writes the page and the picture of a usable fit, as far as they are requested. `report` is
// FitReport() of the run. Each file is written atomically.
Status WriteFitPictures(const FitRun& run, const nlohmann::ordered_json& report);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_PICTURE_H_
