// GunzipStart() in a build without zlib.
#include "ceres_ed/io/field/gzip_reader.h"

namespace ceres_ed {

StatusOr<std::string> GunzipStart(const std::string& path,
                                  const std::string& /*compressed*/,
                                  std::size_t /*size*/) {
  return Status::Error(path +
                       ": is compressed, which this build of ceres_ed cannot read: install "
                       "zlib1g-dev and build again");
}

}  // namespace ceres_ed
