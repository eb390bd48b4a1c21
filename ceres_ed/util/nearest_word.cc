#include "ceres_ed/util/nearest_word.h"

#include <algorithm>

namespace ceres_ed {

int EditDistance(const std::string& a, const std::string& b) {
  const std::size_t rows = a.size() + 1;
  const std::size_t columns = b.size() + 1;
  // Entry (i, j) is the distance of the first i letters of `a` and the first j of `b`.
  std::vector<int> table(rows * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> int& { return table[i * columns + j]; };
  for (std::size_t i = 0; i < rows; ++i) at(i, 0) = static_cast<int>(i);
  for (std::size_t j = 0; j < columns; ++j) at(0, j) = static_cast<int>(j);
  for (std::size_t i = 1; i < rows; ++i) {
    for (std::size_t j = 1; j < columns; ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : 1;
      int& best = at(i, j);
      best = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) best = std::min(best, at(i - 2, j - 2) + 1);
    }
  }
  return table.back();
}

std::string NearestWord(const std::string& misspelt, const std::vector<std::string>& words) {
  const int most = std::max(1, static_cast<int>(misspelt.size()) / 3);
  int smallest = most + 1;
  std::string nearest;
  for (const std::string& word : words) {
    const int distance = EditDistance(misspelt, word);
    if (distance >= smallest) continue;
    smallest = distance;
    nearest = word;
  }
  return nearest;
}

}  // namespace ceres_ed
