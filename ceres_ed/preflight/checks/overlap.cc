#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/unit_ratio.h>

#include <algorithm>
#include <cmath>

namespace ceres_ed {
namespace {

constexpr std::size_t kSamples = 1000;
// Points overlap if they are at most this share of the smaller diagonal apart.
constexpr double kReach = 0.1;
// Two states of one body overlap by more than this share of the one that overlaps more.
constexpr double kTiny = 0.1;

double ShareWithin(const PointCloud& cloud, const KdTree& tree, double reach) {
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / kSamples);
  int near = 0;
  int count = 0;
  for (std::size_t i = 0; i < cloud.size(); i += step, ++count) {
    if (tree.NearestWithin(cloud.points[i], reach).found()) ++near;
  }
  return static_cast<double>(near) / count;
}

}  // namespace

void CheckOverlap(const Specimen& source, const Specimen& target, std::vector<Finding>* findings) {
  const double from = Diagonal(source.cloud->points);
  const double to = Diagonal(target.cloud->points);
  // In another unit nothing can overlap: that is named already.
  if (!(from > 0.0) || !(to > 0.0)) return;
  if (std::max(from / to, to / from) > kPlausibleSizeRatio) return;
  const double reach = kReach * std::min(from, to);
  const KdTree source_tree(source.cloud->points);
  const KdTree target_tree(target.cloud->points);
  const double share = std::max(ShareWithin(*source.cloud, target_tree, reach),
                                ShareWithin(*target.cloud, source_tree, reach));
  if (share >= kTiny) return;
  findings->push_back({"overlap",
                       Severity::kNote,
                       "only " + std::to_string(std::lround(100.0 * share)) + " % of " +
                           source.name + " is near " + target.name + " where they are",
                       "a fit searches the placement; give --landmarks if it finds a wrong one, "
                       "and do not use --rigid_first=false",
                       share});
}

}  // namespace ceres_ed
