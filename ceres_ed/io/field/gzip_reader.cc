#include "ceres_ed/io/field/gzip_reader.h"

#include <zlib.h>

namespace ceres_ed {

StatusOr<std::string> GunzipStart(const std::string& path,
                                  const std::string& compressed,
                                  std::size_t size) {
  constexpr int kGzipHeader = 16;
  const Status damaged = Status::Error(path + ": damaged, expected data compressed by gzip");
  z_stream state = {};
  if (inflateInit2(&state, MAX_WBITS + kGzipHeader) != Z_OK) return damaged;
  std::string bytes(size, '\0');
  // zlib does not write to its input.
  state.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(compressed.data()));
  state.avail_in = static_cast<uInt>(compressed.size());
  state.next_out = reinterpret_cast<unsigned char*>(bytes.data());
  state.avail_out = static_cast<uInt>(bytes.size());
  const int result = inflate(&state, Z_SYNC_FLUSH);
  bytes.resize(size - state.avail_out);
  inflateEnd(&state);
  // The input was cut off, so that an end which is not reached is no error.
  if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR) return damaged;
  return bytes;
}

}  // namespace ceres_ed
