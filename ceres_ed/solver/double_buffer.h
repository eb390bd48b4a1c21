// Memory of the large arrays of a factorisation.
#ifndef CERES_ED_SOLVER_DOUBLE_BUFFER_H_
#define CERES_ED_SOLVER_DOUBLE_BUFFER_H_

#include <cstddef>
#include <memory>

namespace ceres_ed {

// Doubles that start on a line of the cache and aren't set: memory that isn't needed isn't touched.
// Large ones ask the system for large pages, which take it a small part of the time to hand out.
class DoubleBuffer {
 public:
  explicit DoubleBuffer(std::size_t size);

  double* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(double* data) const;
  };

  std::size_t size_;
  std::unique_ptr<double, Free> data_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DOUBLE_BUFFER_H_
