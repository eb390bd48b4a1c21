// The order of the bytes of a number in memory and in a file.
#ifndef CERES_ED_IO_MESH_BYTE_ORDER_H_
#define CERES_ED_IO_MESH_BYTE_ORDER_H_

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ceres_ed {

// Returns whether this machine stores the lowest byte of a number first.
inline bool HostIsLittleEndian() {
  const std::uint16_t one = 1;
  unsigned char first_byte = 0;
  std::memcpy(&first_byte, &one, 1);
  return first_byte == 1;
}

// Returns the number whose bytes begin at `bytes`. They are in the order of this machine, or in the
// reverse order if kReversed is true. `bytes` need not be aligned.
template <typename T, bool kReversed>
T NumberFromBytes(const char* bytes) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), bytes, sizeof(T));
  if constexpr (kReversed) std::reverse(own.begin(), own.end());
  T number;
  std::memcpy(&number, own.data(), sizeof(T));
  return number;
}

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_BYTE_ORDER_H_
