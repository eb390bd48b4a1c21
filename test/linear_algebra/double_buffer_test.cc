#include "ceres_ed/linear_algebra/double_buffer.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <utility>

#include <gtest/gtest.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace ceres_ed {
namespace {

TEST(DoubleBuffer, StartsOnACacheLine) {
  for (const std::size_t size : {1, 1000, 1 << 18, 1 << 23}) {
    DoubleBuffer buffer(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.data()) % 64, 0u) << size;
    buffer.data()[0] = 1.0;
    buffer.data()[size - 1] = 2.0;
    EXPECT_EQ(buffer.data()[size - 1], 2.0);
  }
}

TEST(DoubleBuffer, HasRoomForWhatIsRequired) {
  DoubleBuffer buffer(0);
  for (const std::size_t size : {10, 1 << 20, 1 << 18, 3 << 20}) {
    buffer.Require(size);
    ASSERT_GE(buffer.size(), size);
    buffer.data()[size - 1] = 1.0;
  }
  DoubleBuffer moved = std::move(buffer);
  EXPECT_EQ(moved.data()[(3 << 20) - 1], 1.0);
}

#ifdef __GLIBC__
// Returns the memory of this process that is in use, in bytes.
double ResidentBytes() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// The programs make the heap keep what is freed.
TEST(DoubleBuffer, GivesLargeArraysBackToTheSystem) {
  // NOLINTBEGIN(concurrency-mt-unsafe): there is only one thread.
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  // NOLINTEND(concurrency-mt-unsafe)
  constexpr std::size_t kSize = std::size_t{1} << 22;
  DoubleBuffer buffer(kSize);
  const double before = ResidentBytes();
  for (std::size_t i = 0; i < kSize; i += 100) buffer.data()[i] = 1.0;
  EXPECT_GT(ResidentBytes(), before + 0.9 * kSize * sizeof(double));
  buffer = DoubleBuffer(0);
  EXPECT_LT(ResidentBytes(), before + 0.1 * kSize * sizeof(double));
}
#endif

}  // namespace
}  // namespace ceres_ed
