// Says what a user may have meant by a file that cannot be read as what it should be.
#ifndef CERES_ED_PIPELINE_INTENTION_H_
#define CERES_ED_PIPELINE_INTENTION_H_

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// What a file turns out to be, by its content.
enum class FileKind { kMissing, kFolder, kWarp, kReport, kLandmarks, kVolume, kPicture, kOther };

FileKind KindOfFile(const std::string& path);

// LoadCloud() and ReadWarp(), whose errors also say what the file seems to be, and what to use it
// for or which file may have been meant.
StatusOr<LoadedCloud> LoadSurface(const std::string& path);
StatusOr<Warp> LoadWarp(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_INTENTION_H_
