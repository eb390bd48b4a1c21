// ed_apply on a mesh or on points.
#ifndef CERES_ED_APPS_APPLY_CLOUD_H_
#define CERES_ED_APPS_APPLY_CLOUD_H_

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/util/status.h>

#include <string>

#include <apps/apply_settings.h>

namespace ceres_ed {

// Mends a surface as the fit of `warp` has mended its source, and notes it in the warnings.
void RepairAsInFit(const std::string& path, const Warp& warp, LoadedCloud* loaded);

// Reads what is to be deformed, and leaves out what a fit would.
StatusOr<LoadedCloud> LoadCloudToDeform(const std::string& path, const Warp& warp);

// Warns of what was left out of the cloud, and of one that is not in the unit of the warp.
void WarnOfCloud(const LoadedCloud& loaded,
                 const std::string& path,
                 const Warp& warp,
                 const std::string& warp_path);

// Deforms the cloud, and writes it or its displacement. Points without faces are carried by
// `surface`, the source of the fit; it may be null.
Outcome ApplyToCloud(const ApplySettings& settings,
                     const std::string& warp_path,
                     const Warp& warp,
                     const LoadedCloud& loaded,
                     const LoadedCloud* surface);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_APPLY_CLOUD_H_
