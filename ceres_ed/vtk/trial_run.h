// Tries code that may end the process.
#ifndef CERES_ED_VTK_TRIAL_RUN_H_
#define CERES_ED_VTK_TRIAL_RUN_H_

#include <cstddef>
#include <functional>

namespace ceres_ed {

// Runs `code` in a copy of this process, without its output, and returns whether it came to its
// end, returned true, and took at most `more_bytes` of memory. VTK's legacy reader follows a null
// pointer where a file ends early, and believes any count, which no check ahead of it could tell
// without reading the file as a whole. Returns true if no copy can be made.
bool EndsWell(const std::function<bool()>& code, std::size_t more_bytes);

}  // namespace ceres_ed

#endif  // CERES_ED_VTK_TRIAL_RUN_H_
