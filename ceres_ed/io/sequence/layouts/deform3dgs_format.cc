// What the converter of Deform3DGS makes of StereoMIS: the folders of EndoNeRF, with masks in which
// white is the tissue, and with cy and cx in the place of height and width.
#include <ceres_ed/io/sequence/layouts/llff_folders.h>
#include <ceres_ed/io/sequence/sequence_format.h>

namespace ceres_ed {

bool IsDeform3dgs(const std::string& directory) { return HasCenterForSize(directory); }

StatusOr<SequenceListing> ListDeform3dgs(const std::string& directory) {
  return ListLlffFolders(directory, MaskMeaning::kUsed);
}

}  // namespace ceres_ed
