// GzipWriter in a build without zlib.
#include "ceres_ed/io/field/gzip_writer.h"

#include <glog/logging.h>

namespace ceres_ed {

struct GzipWriter::Impl {};

bool HasGzip() { return false; }

GzipWriter::GzipWriter(std::ostream* /*stream*/) {
  LOG(FATAL) << "this build of ceres_ed has no zlib";
}

GzipWriter::~GzipWriter() = default;

void GzipWriter::Write(const void* /*bytes*/, std::size_t /*size*/) {}

void GzipWriter::Finish() {}

}  // namespace ceres_ed
