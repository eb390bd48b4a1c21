// What ed_apply says of transforms for other tools.
#ifndef CERES_ED_APPS_APPLY_FIELD_H_
#define CERES_ED_APPS_APPLY_FIELD_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/pipeline/apply/field_settings.h>
#include <ceres_ed/pipeline/outcome.h>

#include <string>

namespace ceres_ed {

// Writes the files that `settings` name (RunField()), and prints what they are. `cloud` may be
// null.
Outcome ApplyField(const FieldSettings& settings,
                   const std::string& warp_path,
                   const Warp& warp,
                   const PointCloud* cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_APPLY_FIELD_H_
