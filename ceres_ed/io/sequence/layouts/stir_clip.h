// The clip in a folder of STIR.
#ifndef CERES_ED_IO_SEQUENCE_LAYOUTS_STIR_CLIP_H_
#define CERES_ED_IO_SEQUENCE_LAYOUTS_STIR_CLIP_H_

#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns the folder left*/seqNN of the one clip in `directory`, which is that folder itself or the
// folder of a recording. It is an error if there is none, or more than one.
StatusOr<std::string> FindStirClip(const std::string& directory);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_LAYOUTS_STIR_CLIP_H_
