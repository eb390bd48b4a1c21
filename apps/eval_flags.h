// The command line of ed_eval.
#ifndef CERES_ED_APPS_EVAL_FLAGS_H_
#define CERES_ED_APPS_EVAL_FLAGS_H_

#include <ceres_ed/pipeline/evaluate/evaluate_settings.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Returns the settings of the flags and the positional arguments. It is an error if they mix the
// two uses, or give only half of one.
StatusOr<EvalSettings> ReadEvalFlags(const std::vector<std::string>& arguments);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_FLAGS_H_
