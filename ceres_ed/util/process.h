// Processes, as what they leave on disk names them.
#ifndef CERES_ED_UTIL_PROCESS_H_
#define CERES_ED_UTIL_PROCESS_H_

#include <string>
#include <string_view>

namespace ceres_ed {

// Returns "HOST.PID" of this process: the name of the machine, and the number of the process. Both
// together are unique on a disk that several machines share.
std::string ProcessName();

// Returns whether what has a name that begins with `text` was left by a process that is gone:
// `text` begins with the "HOST.PID" of this machine, followed by a dot or by nothing, and no such
// process exists. This process counts as gone, so that it must ask before it leaves anything
// itself. `rest` gets what follows the dot. What other machines have left is never said to be
// abandoned.
bool IsAbandoned(std::string_view text, std::string_view* rest);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_PROCESS_H_
