// Runs ed_simulate.
#ifndef CERES_ED_APPS_SIMULATE_RUN_H_
#define CERES_ED_APPS_SIMULATE_RUN_H_

#include <string>
#include <vector>

#include <apps/support/program.h>

namespace ceres_ed {

// Writes the sequence that the flags describe. `arguments` is SCENE.
Outcome RunSimulate(const std::vector<std::string>& arguments);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SIMULATE_RUN_H_
