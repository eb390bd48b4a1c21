// The queue of a search along a surface.
#ifndef CERES_ED_GEOMETRY_DISTANCE_QUEUE_H_
#define CERES_ED_GEOMETRY_DISTANCE_QUEUE_H_

#include <cstddef>
#include <vector>

namespace ceres_ed {

// A priority queue of entries with `bool operator<`, the least first: a heap with four children a
// place, half as deep as one of two.
template <typename Entry>
class DistanceQueue {
 public:
  bool empty() const { return entries_.empty(); }
  void reserve(std::size_t size) { entries_.reserve(size); }

  void Push(const Entry& entry) {
    std::size_t place = entries_.size();
    entries_.push_back(entry);
    while (place > 0) {
      const std::size_t parent = (place - 1) / kChildren;
      if (!(entry < entries_[parent])) break;
      entries_[place] = entries_[parent];
      place = parent;
    }
    entries_[place] = entry;
  }

  // The queue isn't empty.
  Entry Pop() {
    const Entry least = entries_.front();
    const Entry last = entries_.back();
    entries_.pop_back();
    const std::size_t size = entries_.size();
    if (size == 0) return least;
    std::size_t place = 0;
    for (std::size_t first; (first = kChildren * place + 1) < size;) {
      const std::size_t end = first + kChildren < size ? first + kChildren : size;
      std::size_t child = first;
      for (std::size_t other = first + 1; other < end; ++other) {
        if (entries_[other] < entries_[child]) child = other;
      }
      if (!(entries_[child] < last)) break;
      entries_[place] = entries_[child];
      place = child;
    }
    entries_[place] = last;
    return least;
  }

 private:
  static constexpr std::size_t kChildren = 4;

  std::vector<Entry> entries_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_DISTANCE_QUEUE_H_
