// Decompression of the start of a file.
#ifndef CERES_ED_IO_FIELD_GZIP_READER_H_
#define CERES_ED_IO_FIELD_GZIP_READER_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>

namespace ceres_ed {

// Returns what the first bytes of a gzip file mean, at most `size` bytes of it. The error says that
// they are damaged, or that this build can't decompress. `path` is for messages.
StatusOr<std::string> GunzipStart(const std::string& path,
                                  const std::string& compressed,
                                  std::size_t size);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_GZIP_READER_H_
