// The course of ed_fit: read, fit, write, tell.
#ifndef CERES_ED_APPS_FIT_RUN_H_
#define CERES_ED_APPS_FIT_RUN_H_

#include <string>
#include <vector>

#include <apps/support/program.h>

namespace ceres_ed {

// Returns how the run ended. `arguments` are SOURCE and, where there is one, TARGET; everything
// else comes from the flags.
Outcome RunFit(const std::vector<std::string>& arguments);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_FIT_RUN_H_
