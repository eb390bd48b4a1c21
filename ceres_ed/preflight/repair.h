// Mends the faults of a cloud that can be mended without a choice.
#ifndef CERES_ED_PREFLIGHT_REPAIR_H_
#define CERES_ED_PREFLIGHT_REPAIR_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Removes triangles that are there twice or have no area, and moves points at borders to the place
// of the point with which they nearly coincide (by at most a thousandth of the mean edge). Points
// keep their number and order. Returns a sentence for each thing that was done; `name` is its
// subject.
std::vector<std::string> RepairCloud(const std::string& name, PointCloud* cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_PREFLIGHT_REPAIR_H_
