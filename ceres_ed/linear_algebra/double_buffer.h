// Memory of the large arrays of a factorisation.
#ifndef CERES_ED_LINEAR_ALGEBRA_DOUBLE_BUFFER_H_
#define CERES_ED_LINEAR_ALGEBRA_DOUBLE_BUFFER_H_

#include <cstddef>
#include <memory>

namespace ceres_ed {

// Asks the system for large pages in a range that has not been touched yet: it hands them out in a
// small part of the time. A wish: where it isn't granted nothing is lost.
void WishForLargePages(void* data, std::size_t bytes);

// Doubles that start on a line of the cache and aren't set: memory that isn't needed isn't touched.
// Large ones wish for large pages.
class DoubleBuffer {
 public:
  explicit DoubleBuffer(std::size_t size);

  // Sees to it that there are `size` doubles; what was there is gone when there were fewer. A
  // little more than asked, so that sizes that go up and down settle.
  void Require(std::size_t size);

  double* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(double* data) const;
  };

  std::size_t size_;
  std::unique_ptr<double, Free> data_;
};

// The memory of a factorisation, to be handed from one to the next.
struct FactorMemory {
  DoubleBuffer panels{0};
  DoubleBuffer updates{0};
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_DOUBLE_BUFFER_H_
