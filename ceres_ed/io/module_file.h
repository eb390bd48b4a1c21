// Finds shared objects of ceres_ed that are loaded only when they are needed.
#ifndef CERES_ED_IO_MODULE_FILE_H_
#define CERES_ED_IO_MODULE_FILE_H_

#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns the address of `symbol` in the shared object `file` (a name without folders), which stays
// loaded. It is searched in the folder of the environment variable CERES_ED_MODULES if that is set,
// next to the program or library that calls, in the folder of libraries that belongs to it, and in
// the system's folders of libraries. The error gives the message of the system.
StatusOr<void*> OpenModule(const std::string& file, const char* symbol);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MODULE_FILE_H_
