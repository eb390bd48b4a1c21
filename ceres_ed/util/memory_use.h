// What containers hold on the heap.
#ifndef CERES_ED_UTIL_MEMORY_USE_H_
#define CERES_ED_UTIL_MEMORY_USE_H_

#include <algorithm>
#include <cstddef>
#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ceres_ed {

// Bytes that a 64-bit glibc takes for an allocation of `bytes`: eight for its size, in steps of 16.
constexpr std::size_t HeapBytes(std::size_t bytes) {
  if (bytes == 0) return 0;
  return std::max<std::size_t>(32, (bytes + 8 + 15) / 16 * 16);
}

// Bytes that a container holds on the heap, whatever of it is in use; not what its elements hold
// there in turn.
template <typename T>
std::size_t HeapBytesOf(const std::vector<T>& values) {
  return HeapBytes(values.capacity() * sizeof(T));
}

// As libstdc++ has it: blocks of 512 bytes, or of one element, and a pointer to each.
template <typename T>
std::size_t HeapBytesOf(const std::deque<T>& values) {
  constexpr std::size_t kPerBlock = std::max<std::size_t>(1, 512 / sizeof(T));
  const std::size_t blocks = values.size() / kPerBlock + 1;
  return blocks * (HeapBytes(kPerBlock * sizeof(T)) + sizeof(void*));
}

// A node for each element, with a pointer to the next, and the buckets. Hashes of whole numbers
// are not kept.
template <typename K, typename V>
std::size_t HeapBytesOf(const std::unordered_map<K, V>& values) {
  return values.size() * HeapBytes(sizeof(void*) + sizeof(std::pair<const K, V>)) +
         HeapBytes(values.bucket_count() * sizeof(void*));
}

// The same with what the elements, vectors of their own, hold.
template <typename Outer>
std::size_t HeapBytesOfAll(const Outer& lists) {
  std::size_t bytes = HeapBytesOf(lists);
  for (const auto& list : lists) bytes += HeapBytesOf(list);
  return bytes;
}

// Appends to one of very many short lists: room grows by an eighth, where push_back() doubles it
// and leaves a third of it idle.
template <typename T>
void PushBackTightly(const T& value, std::vector<T>* values) {
  constexpr std::size_t kLeast = 4;
  const std::size_t size = values->size();
  if (size == values->capacity()) values->reserve(size + std::max(kLeast, size / 8));
  values->push_back(value);
}

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_MEMORY_USE_H_
