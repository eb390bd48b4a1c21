// EndoNeRF: images/, depth/, masks/ in which white is the tool, and poses_bounds.npy.
#include <ceres_ed/io/sequence/layouts/llff_folders.h>
#include <ceres_ed/io/sequence/sequence_format.h>

namespace ceres_ed {

bool IsEndoNerf(const std::string& directory) { return !LlffPosesPath(directory).empty(); }

StatusOr<SequenceListing> ListEndoNerf(const std::string& directory) {
  return ListLlffFolders(directory, MaskMeaning::kLeftOut);
}

}  // namespace ceres_ed
