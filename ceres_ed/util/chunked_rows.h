// Rows of numbers whose addresses never change.
#ifndef CERES_ED_UTIL_CHUNKED_ROWS_H_
#define CERES_ED_UTIL_CHUNKED_ROWS_H_

#include <ceres_ed/util/memory_use.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ceres_ed {

// A table with `width` elements in each row. It is stored in chunks of 256 rows, so adding rows
// does not copy existing ones, and pointers to them stay valid.
template <typename T>
class ChunkedRows {
 public:
  explicit ChunkedRows(int width) : width_(static_cast<std::size_t>(width)) {}

  int width() const { return static_cast<int>(width_); }
  std::size_t size() const { return size_; }

  T* operator[](std::size_t row) { return &chunks_[row >> kBits][(row & kMask) * width_]; }
  const T* operator[](std::size_t row) const {
    return &chunks_[row >> kBits][(row & kMask) * width_];
  }

  // The memory on the heap, in bytes.
  std::size_t HeapBytes() const { return HeapBytesOfAll(chunks_); }

  // Changes the number of rows. New rows are filled with T().
  void Resize(std::size_t rows) {
    const std::size_t room = chunks_.size() << kBits;
    for (std::size_t row = size_; row < rows && row < room; ++row) {
      std::fill_n((*this)[row], width_, T());
    }
    const std::size_t before = chunks_.size();
    chunks_.resize((rows + kMask) >> kBits);
    for (std::size_t c = before; c < chunks_.size(); ++c) chunks_[c].resize(width_ << kBits);
    size_ = rows;
  }

 private:
  static constexpr std::size_t kBits = 8;
  static constexpr std::size_t kMask = (std::size_t{1} << kBits) - 1;

  std::size_t width_;
  std::size_t size_ = 0;
  std::vector<std::vector<T>> chunks_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_CHUNKED_ROWS_H_
