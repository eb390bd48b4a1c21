// ed_apply on landmarks.
#ifndef CERES_ED_APPS_APPLY_LANDMARKS_H_
#define CERES_ED_APPS_APPLY_LANDMARKS_H_

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/outcome.h>

#include <string>

#include <apps/apply_settings.h>

namespace ceres_ed {

// Moves the landmarks of a file, and writes them in the same format. They are carried by `surface`,
// the source of the fit; if it is null, they follow the nearest nodes.
Outcome ApplyToLandmarks(const ApplySettings& settings,
                         const std::string& warp_path,
                         const Warp& warp,
                         const std::string& input,
                         const LoadedCloud* surface);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_APPLY_LANDMARKS_H_
