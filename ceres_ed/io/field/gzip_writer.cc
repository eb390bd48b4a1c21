#include "ceres_ed/io/field/gzip_writer.h"

#include <algorithm>
#include <vector>

#include <glog/logging.h>
#include <zlib.h>

namespace ceres_ed {

struct GzipWriter::Impl {
  // Compresses what the input of `state` has, and hands on what comes out.
  void Run(int flush) {
    do {
      state.next_out = buffer.data();
      state.avail_out = static_cast<uInt>(buffer.size());
      CHECK_NE(deflate(&state, flush), Z_STREAM_ERROR);
      const std::size_t size = buffer.size() - state.avail_out;
      stream->write(reinterpret_cast<const char*>(buffer.data()),
                    static_cast<std::streamsize>(size));
    } while (state.avail_out == 0);
  }

  std::ostream* stream = nullptr;
  z_stream state = {};
  std::vector<unsigned char> buffer = std::vector<unsigned char>(1 << 16);
};

bool HasGzip() { return true; }

GzipWriter::GzipWriter(std::ostream* stream) : impl_(std::make_unique<Impl>()) {
  impl_->stream = stream;
  constexpr int kGzipHeader = 16;
  constexpr int kMemoryLevel = 8;
  // Displacements compress little; the fastest level gains nearly all that there is.
  CHECK_EQ(deflateInit2(&impl_->state,
                        Z_BEST_SPEED,
                        Z_DEFLATED,
                        MAX_WBITS + kGzipHeader,
                        kMemoryLevel,
                        Z_DEFAULT_STRATEGY),
           Z_OK);
}

GzipWriter::~GzipWriter() { deflateEnd(&impl_->state); }

void GzipWriter::Write(const void* bytes, std::size_t size) {
  constexpr std::size_t kMostAtOnce = 1 << 24;
  const auto* next = static_cast<const unsigned char*>(bytes);
  while (size > 0) {
    const std::size_t part = std::min(size, kMostAtOnce);
    // zlib does not write to its input.
    impl_->state.next_in = const_cast<unsigned char*>(next);
    impl_->state.avail_in = static_cast<uInt>(part);
    impl_->Run(Z_NO_FLUSH);
    next += part;
    size -= part;
  }
}

void GzipWriter::Finish() {
  impl_->state.avail_in = 0;
  impl_->Run(Z_FINISH);
}

}  // namespace ceres_ed
