// The first bytes of files that may be compressed.
#ifndef CERES_ED_IO_FIELD_FILE_START_H_
#define CERES_ED_IO_FIELD_FILE_START_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>

namespace ceres_ed {

// Returns the first bytes of a file, at most `size` of them. A file that is compressed as by gzip
// is decompressed if this build can do that. The error gives the system's reason.
StatusOr<std::string> ReadStart(const std::string& path, std::size_t size);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_FILE_START_H_
