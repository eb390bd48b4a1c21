// What the allocator should know ahead of the first fit.
#ifndef CERES_ED_PYTHON_MEMORY_H_
#define CERES_ED_PYTHON_MEMORY_H_

#include <cstddef>
#include <cstdlib>

namespace ceres_ed::python {

// Has glibc keep blocks of up to 32 MB when they are freed, as it does in any process that has once
// freed one so large: it learns by that, and a fit would be a tenth slower while it learns,
// fetching the same memory from the system again and again. The programs go further (mallopt), but
// this process isn't ours: what is done here sets nothing, and touches no page.
inline void ExpectLargeBlocks() {
#ifdef __GLIBC__
  static const bool done = [] {
    // Less what would round up to more than glibc lets itself learn (DEFAULT_MMAP_THRESHOLD_MAX).
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
