// Prepares the memory allocator for the first fit.
#ifndef CERES_ED_PYTHON_MEMORY_H_
#define CERES_ED_PYTHON_MEMORY_H_

#include <cstddef>
#include <cstdlib>

namespace ceres_ed::python {

// Makes glibc keep blocks of up to 32 MB when they are freed. In any process glibc learns to do so
// when such a block has been freed once. Without this function it learns during the first fit,
// which then takes a tenth longer, because it requests the same memory from the system again and
// again. The programs also call mallopt(), but the settings of this process belong to its user:
// this function changes no setting and keeps no memory.
inline void ExpectLargeBlocks() {
#ifdef __GLIBC__
  static const bool done = [] {
    // The largest threshold that glibc learns is 32 MB (DEFAULT_MMAP_THRESHOLD_MAX), and it rounds
    // the size of a block up.
    constexpr std::size_t kLargest = (std::size_t{32} << 20) - (std::size_t{64} << 10);
    void* volatile block = std::malloc(kLargest);
    std::free(block);
    return true;
  }();
  (void)done;
#endif
}

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_MEMORY_H_
