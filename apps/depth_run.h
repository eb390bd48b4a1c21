// Runs ed_depth.
#ifndef CERES_ED_APPS_DEPTH_RUN_H_
#define CERES_ED_APPS_DEPTH_RUN_H_

#include <string>
#include <vector>

#include <apps/support/program.h>

namespace ceres_ed {

// Writes the depth of the sequence that the flags describe. `arguments` is SEQUENCE.
Outcome RunDepthProgram(const std::vector<std::string>& arguments);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_DEPTH_RUN_H_
