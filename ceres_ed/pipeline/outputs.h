// Files that a run is going to write.
#ifndef CERES_ED_PIPELINE_OUTPUTS_H_
#define CERES_ED_PIPELINE_OUTPUTS_H_

#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Makes the folder of `path` where it is missing, and returns ok when the file can be written. It
// is left as it was. Error: names the path and the system's reason.
Status PrepareOutput(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_OUTPUTS_H_
