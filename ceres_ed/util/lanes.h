// Vectors of four numbers for SIMD instructions.
#ifndef CERES_ED_UTIL_LANES_H_
#define CERES_ED_UTIL_LANES_H_

#include <cstdint>

// The way in which lanes are passed to a function depends on the processor. Functions that are
// always inlined do not pass any.
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace ceres_ed {

constexpr int kLanes = 4;

// Arithmetic and comparisons work on each lane, and a single number is copied to all lanes. A
// comparison gives a mask in which the bits of a lane are all set or all clear. The compiler uses
// the instructions of the processor, also in a function for each machine (for_each_machine.h). The
// alignment is given since plain x86-64 would use a smaller one.
using Lanes [[gnu::vector_size(kLanes * sizeof(double)), gnu::aligned(32)]] = double;
using LaneMask [[gnu::vector_size(kLanes * sizeof(std::int64_t)), gnu::aligned(32)]] = std::int64_t;

// Returns `a` where the mask is set and 0 elsewhere.
[[gnu::always_inline]] inline Lanes Where(const LaneMask& mask, const Lanes& a) {
  return reinterpret_cast<Lanes>(mask & reinterpret_cast<LaneMask>(a));
}

// Returns `a` where the mask is set and `b` elsewhere.
[[gnu::always_inline]] inline Lanes Select(const LaneMask& mask, const Lanes& a, const Lanes& b) {
  return mask ? a : b;
}

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_LANES_H_
