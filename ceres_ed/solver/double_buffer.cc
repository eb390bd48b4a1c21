#include "ceres_ed/solver/double_buffer.h"

#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ceres_ed {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kLargePage = std::size_t{1} << 21;

std::size_t RoundUp(std::size_t size, std::size_t unit) { return (size + unit - 1) / unit * unit; }

double* Allocate(std::size_t size) {
  const std::size_t bytes = size * sizeof(double);
  const bool is_large = bytes >= 2 * kLargePage;
  const std::size_t unit = is_large ? kLargePage : kCacheLine;
  void* data = std::aligned_alloc(unit, RoundUp(bytes > 0 ? bytes : 1, unit));
  if (data == nullptr) throw std::bad_alloc();
#ifdef __linux__
  // A wish: where it isn't granted nothing is lost.
  if (is_large) static_cast<void>(madvise(data, RoundUp(bytes, unit), MADV_HUGEPAGE));
#endif
  return static_cast<double*>(data);
}

}  // namespace

DoubleBuffer::DoubleBuffer(std::size_t size) : size_(size), data_(Allocate(size)) {}

void DoubleBuffer::Free::operator()(double* data) const { std::free(data); }

}  // namespace ceres_ed
