// Checks the files that a run is going to write.
#ifndef CERES_ED_PIPELINE_OUTPUTS_H_
#define CERES_ED_PIPELINE_OUTPUTS_H_

#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Creates the folder of `path` if it does not exist, and returns ok if the file can be written. The
// file itself is not changed. The error names the path and gives the system's reason.
Status PrepareOutput(const std::string& path);

// Returns whether `output` is the folder `sequence`, or a folder within it that has pictures: what
// a run writes there would lie among its input, and take the place of files of the same name.
bool IsFolderOfSequence(const std::string& output, const std::string& sequence);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_OUTPUTS_H_
