#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/normals.h>

#include <algorithm>
#include <cmath>

namespace ceres_ed {
namespace {

// The distance of nodes that a fit chooses, as a share of the diagonal.
constexpr double kNodeSpacing = 0.05;
// The samples whose surroundings are looked at, and those of which the surroundings consist.
constexpr std::size_t kPatches = 300;
constexpr std::size_t kSamples = 8000;
// Normals whose mean, of those on the same side, is shorter than this point everywhere: of a
// hemisphere it is 0.5, of a thin limb 0.64, of a smooth body about 0.9.
constexpr double kCrumpled = 0.58;
constexpr double kHarmlessShare = 0.3;

}  // namespace

void CheckDetail(const Specimen& specimen, std::vector<Finding>* findings) {
  const PointCloud& cloud = *specimen.cloud;
  if (!cloud.HasTriangles()) return;
  const std::vector<int>& order = specimen.topology->walk_order;
  std::vector<int> candidates;
  const std::size_t step = std::max<std::size_t>(1, order.size() / kSamples);
  for (std::size_t i = 0; i < order.size(); i += step) candidates.push_back(order[i]);
  const std::vector<Eigen::Vector3d> computed =
      ComputeVertexNormalsAt(candidates, cloud, *specimen.topology);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (computed[i].isZero()) continue;
    points.push_back(cloud.points[candidates[i]]);
    normals.push_back(computed[i]);
  }
  const KdTree tree(points);
  const double radius = kNodeSpacing * Diagonal(cloud.points);
  std::vector<Neighbor> patch;
  int looked_at = 0;
  int crumpled = 0;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kPatches);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    tree.RadiusSearch(points[i], radius, &patch);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (const Neighbor& neighbor : patch) {
      const Eigen::Vector3d& normal = normals[neighbor.index];
      if (normal.dot(normals[i]) <= 0.0) continue;
      sum += normal;
      ++count;
    }
    constexpr int kFew = 8;
    if (count < kFew) continue;
    ++looked_at;
    if (sum.norm() < kCrumpled * count) ++crumpled;
  }
  const double share = looked_at > 0 ? static_cast<double>(crumpled) / looked_at : 0.0;
  if (share <= kHarmlessShare) return;
  findings->push_back({"detail",
                       Severity::kWarning,
                       specimen.name + ": " + std::to_string(std::lround(100.0 * share)) +
                           " % of the surface has folds or noise that are finer than the distance "
                           "of the nodes of a fit",
                       "use a smaller --node_spacing if the folds move by themselves, or smooth "
                       "the surface if it is noise",
                       share});
}

}  // namespace ceres_ed
