// What ed_simulate does.
#ifndef CERES_ED_APPS_SIMULATE_RUN_H_
#define CERES_ED_APPS_SIMULATE_RUN_H_

#include <string>
#include <vector>

#include <apps/support/program.h>

namespace ceres_ed {

// Writes the sequence that the flags ask for; arguments: SCENE.
Outcome RunSimulate(const std::vector<std::string>& arguments);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SIMULATE_RUN_H_
