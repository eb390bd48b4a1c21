#include "ceres_ed/preflight/check_table.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ceres_ed {

void CheckNonManifoldEdges(const Specimen& specimen, std::vector<Finding>* findings) {
  const std::vector<int>& representative = specimen.topology->representative;
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * specimen.cloud->triangles.size());
  for (const std::array<int, 3>& t : specimen.cloud->triangles) {
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(representative[t[i]], representative[t[(i + 1) % 3]]);
      if (low != high) edges.emplace_back(low, high);
    }
  }
  std::sort(edges.begin(), edges.end());
  int count = 0;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if (end - begin > 2) ++count;
    begin = end;
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
