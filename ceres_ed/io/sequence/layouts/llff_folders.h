// The folders of EndoNeRF, which other programs write too.
#ifndef CERES_ED_IO_SEQUENCE_LAYOUTS_LLFF_FOLDERS_H_
#define CERES_ED_IO_SEQUENCE_LAYOUTS_LLFF_FOLDERS_H_

#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns poses_bounds.npy or pose_bounds.npy of a folder that has images/, or "".
std::string LlffPosesPath(const std::string& directory);

// Returns whether such a folder has the principal point where height and width belong, as the
// converter from StereoMIS to EndoNeRF writes it.
bool HasCenterForSize(const std::string& directory);

// Returns the frames of images/, depth/ and masks/. Depth is in millimetres, which is said. The
// masks have the given meaning.
StatusOr<SequenceListing> ListLlffFolders(const std::string& directory, MaskMeaning masks);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_LAYOUTS_LLFF_FOLDERS_H_
