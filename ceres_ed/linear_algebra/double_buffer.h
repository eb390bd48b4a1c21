// Memory for the large arrays of a factorisation.
#ifndef CERES_ED_LINEAR_ALGEBRA_DOUBLE_BUFFER_H_
#define CERES_ED_LINEAR_ALGEBRA_DOUBLE_BUFFER_H_

#include <cstddef>
#include <memory>

namespace ceres_ed {

// Asks the system to use large pages for a range that has not been touched yet, because the system
// provides them in a small part of the time that small pages take. The system may decline, which
// does no harm.
void WishForLargePages(void* data, std::size_t bytes);

// An array of doubles that starts on a cache line and is not initialised, so that memory which is
// not needed is not touched. Large arrays ask for large pages.
class DoubleBuffer {
 public:
  explicit DoubleBuffer(std::size_t size);

  // Ensures that there is room for `size` doubles. The contents are lost if there was less room
  // before. The new array is a little larger than requested, so that sizes which rise and fall do
  // not lead to repeated allocation.
  void Require(std::size_t size);

  double* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    std::size_t size = 0;
    void operator()(double* data) const;
  };

  std::size_t size_;
  std::unique_ptr<double, Free> data_;
};

// The memory of a factorisation, which can be passed from one factorisation to the next.
struct FactorMemory {
  DoubleBuffer panels{0};
  DoubleBuffer updates{0};
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_DOUBLE_BUFFER_H_
