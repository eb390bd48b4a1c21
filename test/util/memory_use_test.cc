#include "ceres_ed/util/memory_use.h"

#include <cstdlib>
#include <deque>
#include <new>
#include <unordered_map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <malloc.h>

namespace {

// The number of bytes that are allocated now, as the allocator counts them.
std::size_t held = 0;

}  // namespace

void* operator new(std::size_t size) {
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  held += malloc_usable_size(memory) + sizeof(std::size_t);
  return memory;
}

void operator delete(void* memory) noexcept {
  if (memory != nullptr) held -= malloc_usable_size(memory) + sizeof(std::size_t);
  std::free(memory);
}

void operator delete(void* memory, std::size_t /*size*/) noexcept { operator delete(memory); }

namespace ceres_ed {
namespace {

// The fraction by which a count may be off: blocks that are too small to be split leave some room.
constexpr double kSlack = 0.05;

template <typename Container, typename Fill, typename Count>
void ExpectCounted(Fill fill, Count count) {
  const std::size_t before = held;
  Container container;
  fill(&container);
  const auto expected = static_cast<double>(held - before);
  EXPECT_NEAR(static_cast<double>(count(container)), expected, kSlack * expected + 600.0);
}

TEST(HeapBytesOf, CountsWhatTheAllocatorGives) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's allocator rounds otherwise";
#endif
  using Lists = std::vector<std::vector<int>>;
  ExpectCounted<std::vector<double>>([](auto* v) { v->resize(1001); },
                                     [](const auto& v) { return HeapBytesOf(v); });
  ExpectCounted<std::deque<std::pair<double, int>>>([](auto* d) { d->resize(5000); },
                                                    [](const auto& d) { return HeapBytesOf(d); });
  ExpectCounted<std::unordered_map<std::size_t, std::vector<int>>>(
      [](auto* map) {
        for (std::size_t i = 0; i < 5000; ++i) (*map)[7 * i];
      },
      [](const auto& map) { return HeapBytesOf(map); });
  ExpectCounted<Lists>(
      [](Lists* lists) {
        lists->resize(3000);
        for (std::size_t i = 0; i < lists->size(); ++i) (*lists)[i].resize(i % 40);
      },
      [](const Lists& lists) { return HeapBytesOfAll(lists); });
}

TEST(HeapBytesOf, IsNothingOfAnEmptyVector) { EXPECT_EQ(HeapBytesOf(std::vector<int>()), 0u); }

TEST(PushBackTightly, LeavesLittleRoomAndKeepsTheOrder) {
  std::vector<int> list;
  for (int i = 0; i < 1000; ++i) {
    PushBackTightly(i, &list);
    ASSERT_LE(list.capacity(), list.size() + 4 + list.size() / 8);
  }
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(list[i], i);
}

}  // namespace
}  // namespace ceres_ed
