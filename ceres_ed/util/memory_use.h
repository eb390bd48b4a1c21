// The memory that containers use on the heap.
#ifndef CERES_ED_UTIL_MEMORY_USE_H_
#define CERES_ED_UTIL_MEMORY_USE_H_

#include <algorithm>
#include <cstddef>
#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ceres_ed {

// Returns the bytes that a 64-bit glibc uses for an allocation of `bytes`: it adds eight for the
// size and rounds up to a multiple of 16.
constexpr std::size_t HeapBytes(std::size_t bytes) {
  if (bytes == 0) return 0;
  return std::max<std::size_t>(32, (bytes + 8 + 15) / 16 * 16);
}

// Returns the bytes that a container has on the heap, including unused capacity. Memory that its
// elements own is not counted.
template <typename T>
std::size_t HeapBytesOf(const std::vector<T>& values) {
  return HeapBytes(values.capacity() * sizeof(T));
}

// Assumes the layout of libstdc++: blocks of 512 bytes, or of one element, and a pointer to each.
template <typename T>
std::size_t HeapBytesOf(const std::deque<T>& values) {
  constexpr std::size_t kPerBlock = std::max<std::size_t>(1, 512 / sizeof(T));
  const std::size_t blocks = values.size() / kPerBlock + 1;
  return blocks * (HeapBytes(kPerBlock * sizeof(T)) + sizeof(void*));
}

// Assumes a node for each element, with a pointer to the next one, and the buckets. Hashes of
// integers are not stored.
template <typename K, typename V>
std::size_t HeapBytesOf(const std::unordered_map<K, V>& values) {
  return values.size() * HeapBytes(sizeof(void*) + sizeof(std::pair<const K, V>)) +
         HeapBytes(values.bucket_count() * sizeof(void*));
}

// Does the same for a container of vectors, and counts the memory of these vectors, too.
template <typename Outer>
std::size_t HeapBytesOfAll(const Outer& lists) {
  std::size_t bytes = HeapBytesOf(lists);
  for (const auto& list : lists) bytes += HeapBytesOf(list);
  return bytes;
}

// Appends to one of very many short lists. The capacity grows by an eighth. push_back() would
// double it, and a third of the memory would be unused.
template <typename T>
void PushBackTightly(const T& value, std::vector<T>* values) {
  constexpr std::size_t kLeast = 4;
  const std::size_t size = values->size();
  if (size == values->capacity()) values->reserve(size + std::max(kLeast, size / 8));
  values->push_back(value);
}

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_MEMORY_USE_H_
