// Compression as that of gzip.
#ifndef CERES_ED_IO_FIELD_GZIP_WRITER_H_
#define CERES_ED_IO_FIELD_GZIP_WRITER_H_

#include <cstddef>
#include <memory>
#include <ostream>

namespace ceres_ed {

// Returns whether this build can compress.
bool HasGzip();

// Compresses bytes into a stream. The same bytes always give the same file: it has no name and no
// time. Use it only if HasGzip().
class GzipWriter {
 public:
  // `stream` must outlive this object. Its state need not be checked before the end.
  explicit GzipWriter(std::ostream* stream);
  ~GzipWriter();
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  void Write(const void* bytes, std::size_t size);
  // Completes the compressed data. Call it once, at the end.
  void Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_GZIP_WRITER_H_
