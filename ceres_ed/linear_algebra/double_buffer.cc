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

// Arrays of at least this size have pages of their own, which go back to the system when they are
// freed. On the heap, each larger one would leave a hole where the last one was. They are few:
// a factor keeps its memory from step to step.
constexpr std::size_t kWorthOwnPages = std::size_t{1} << 20;

#ifdef __linux__
bool HasOwnPages(std::size_t size) { return size * sizeof(double) >= kWorthOwnPages; }

double* AllocatePages(std::size_t size) {
  const std::size_t bytes = size * sizeof(double);
  void* data =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, /*fd=*/-1, 0);
  if (data == MAP_FAILED) throw std::bad_alloc();
  WishForLargePages(data, bytes);
  return static_cast<double*>(data);
}
#endif

double* Allocate(std::size_t size) {
#ifdef __linux__
  if (HasOwnPages(size)) return AllocatePages(size);
#endif
  const std::size_t bytes = size * sizeof(double);
  void* data = std::aligned_alloc(kCacheLine, RoundUp(bytes > 0 ? bytes : 1, kCacheLine));
  if (data == nullptr) throw std::bad_alloc();
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

DoubleBuffer::DoubleBuffer(std::size_t size) : size_(size), data_(Allocate(size), Free{size}) {}

void DoubleBuffer::Require(std::size_t size) {
  if (size <= size_) return;
  const std::size_t new_size = size_ == 0 ? size : size + size / 4;
#ifdef __linux__
  if (HasOwnPages(size_)) {
    // The pages move to the new array, so that they need not be touched for the first time again.
    void* data =
        mremap(data_.get(), size_ * sizeof(double), new_size * sizeof(double), MREMAP_MAYMOVE);
    if (data == MAP_FAILED) throw std::bad_alloc();
    WishForLargePages(data, new_size * sizeof(double));
    static_cast<void>(data_.release());
    data_ = {static_cast<double*>(data), Free{new_size}};
    size_ = new_size;
    return;
  }
#endif
  // The old array is freed first; otherwise both arrays together would be the peak of the memory
  // use.
  data_.reset();
  size_ = 0;
  *this = DoubleBuffer(new_size);
}

void DoubleBuffer::Free::operator()(double* data) const {
#ifdef __linux__
  if (HasOwnPages(size)) {
    munmap(data, size * sizeof(double));
    return;
  }
#endif
  std::free(data);
}

}  // namespace ceres_ed
