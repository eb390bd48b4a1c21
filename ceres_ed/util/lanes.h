// Four numbers that are computed with side by side.
#ifndef CERES_ED_UTIL_LANES_H_
#define CERES_ED_UTIL_LANES_H_

#include <cstdint>

// How lanes are passed depends on the machine; functions that are always inlined pass none.
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace ceres_ed {

constexpr int kLanes = 4;

// Arithmetic and comparisons go lane by lane, and single numbers are spread over all lanes. A
// comparison gives a mask, all bits of a lane set or none. The compiler makes of it what the
// machine has, in a function for each machine (for_each_machine.h) too. Plain x86-64 would align
// them less.
using Lanes [[gnu::vector_size(kLanes * sizeof(double)), gnu::aligned(32)]] = double;
using LaneMask [[gnu::vector_size(kLanes * sizeof(std::int64_t)), gnu::aligned(32)]] = std::int64_t;

// `a` where the mask is set and 0 elsewhere.
[[gnu::always_inline]] inline Lanes Where(const LaneMask& mask, const Lanes& a) {
  return reinterpret_cast<Lanes>(mask & reinterpret_cast<LaneMask>(a));
}

// `a` where the mask is set and `b` elsewhere.
[[gnu::always_inline]] inline Lanes Select(const LaneMask& mask, const Lanes& a, const Lanes& b) {
  return mask ? a : b;
}

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_LANES_H_
