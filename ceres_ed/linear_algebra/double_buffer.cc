#include "ceres_ed/linear_algebra/double_buffer.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ceres_ed {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kLargePage = std::size_t{1} << 21;
// Arrays that are allocated and freed with each frame are smaller than this; whole large pages
// would leave gaps between them.
constexpr std::size_t kWorthLargePages = std::size_t{64} << 20;

std::size_t RoundUp(std::size_t size, std::size_t unit) { return (size + unit - 1) / unit * unit; }

double* Allocate(std::size_t size) {
  const std::size_t bytes = size * sizeof(double);
  const bool is_large = bytes >= kWorthLargePages;
  const std::size_t unit = is_large ? kLargePage : kCacheLine;
  void* data = std::aligned_alloc(unit, RoundUp(bytes > 0 ? bytes : 1, unit));
  if (data == nullptr) throw std::bad_alloc();
  if (is_large) WishForLargePages(data, bytes);
  return static_cast<double*>(data);
}

}  // namespace

void WishForLargePages(void* data, std::size_t bytes) {
#ifdef __linux__
  if (bytes < kWorthLargePages) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = RoundUp(begin, kLargePage);
  const std::uintptr_t last = (begin + bytes) / kLargePage * kLargePage;
  if (first >= last) return;
  char* const pages = static_cast<char*>(data) + (first - begin);
  static_cast<void>(madvise(pages, last - first, MADV_HUGEPAGE));
#else
  static_cast<void>(data);
  static_cast<void>(bytes);
#endif
}

DoubleBuffer::DoubleBuffer(std::size_t size) : size_(size), data_(Allocate(size)) {}

void DoubleBuffer::Require(std::size_t size) {
  if (size <= size_) return;
  // The old array is freed first; otherwise both arrays together would be the peak of the memory
  // use.
  data_.reset();
  *this = DoubleBuffer(size_ == 0 ? size : size + size / 4);
}

void DoubleBuffer::Free::operator()(double* data) const { std::free(data); }

}  // namespace ceres_ed
