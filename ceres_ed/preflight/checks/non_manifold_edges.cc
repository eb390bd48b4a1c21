#include "ceres_ed/preflight/check_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace ceres_ed {
namespace {

// Calls visit(low, high) for each edge of each triangle, with the representatives of its ends.
template <typename Visitor>
void ForEdges(const Specimen& specimen, const Visitor& visit) {
  const std::vector<int>& representative = specimen.topology->representative;
  for (const std::array<int, 3>& t : specimen.cloud->triangles) {
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(representative[t[i]], representative[t[(i + 1) % 3]]);
      if (low != high) visit(low, high);
    }
  }
}

}  // namespace

void CheckNonManifoldEdges(const Specimen& specimen, std::vector<Finding>* findings) {
  // The higher ends of the edges of each lower end: from offsets[low] to offsets[low + 1].
  std::vector<std::size_t> offsets(specimen.cloud->size() + 1, 0);
  ForEdges(specimen, [&](int low, int) { ++offsets[low + 1]; });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<int> ends(offsets.back());
  std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
  ForEdges(specimen, [&](int low, int high) { ends[next[low]++] = high; });
  int count = 0;
  for (std::size_t low = 0; low + 1 < offsets.size(); ++low) {
    const auto last = ends.begin() + static_cast<std::ptrdiff_t>(offsets[low + 1]);
    auto begin = ends.begin() + static_cast<std::ptrdiff_t>(offsets[low]);
    std::sort(begin, last);
    while (begin != last) {
      const auto end = std::upper_bound(begin, last, *begin);
      if (end - begin > 2) ++count;
      begin = end;
    }
  }
  if (count == 0) return;
  findings->push_back(
      {"non_manifold_edges",
       Severity::kNote,
       specimen.name + ": " + std::to_string(count) + " edges belong to more than two triangles",
       "a fit copes with them; look there if the result is folded",
       static_cast<double>(count)});
}

}  // namespace ceres_ed
