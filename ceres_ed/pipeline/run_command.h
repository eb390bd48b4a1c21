// The command that repeats a run.
#ifndef CERES_ED_PIPELINE_RUN_COMMAND_H_
#define CERES_ED_PIPELINE_RUN_COMMAND_H_

#include <ceres_ed/pipeline/run_flag.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns the command with its arguments (empty ones are left out) and every flag that was given,
// quoted for a POSIX shell.
std::string CommandText(const std::string& program,
                        const std::vector<std::string>& arguments,
                        const RunFlags& flags);

// Returns the names of the flags that were given.
nlohmann::ordered_json GivenFlagsReport(const RunFlags& flags);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_RUN_COMMAND_H_
