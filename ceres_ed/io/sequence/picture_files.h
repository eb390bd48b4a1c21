// Names and sizes of image files.
#ifndef CERES_ED_IO_SEQUENCE_PICTURE_FILES_H_
#define CERES_ED_IO_SEQUENCE_PICTURE_FILES_H_

#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// Returns `directory`/`name`.
std::string JoinPath(const std::string& directory, const std::string& name);

// Return whether `path` is a folder (or a file). Links are followed.
bool IsFolder(const std::string& path);
bool IsFile(const std::string& path);

// Returns whether a folder is empty.
bool IsEmptyFolder(const std::string& path);

// Returns the width and height of a depth image in pixels. They are read from the header of a PNG.
// Errors are as those of ReadDepthImage().
StatusOr<std::pair<int, int>> ReadPictureSize(const std::string& path);

// Sets the camera's size from the first frame whose image can be read. It is an error if there is
// none.
Status SetSizeFromPictures(const std::vector<SequenceEntry>& entries, PinholeCamera* camera);

// The paths of folders of numbered images; empty if there is none.
struct PictureFolders {
  std::string depth;
  std::string color;
  std::string mask;
};

// Returns the frames of the folders: one for each number of a depth image. The time of a frame is
// its number. It is an error if there is no depth folder, if it has no image, or if two files have
// the same number.
StatusOr<SequenceListing> ListPictureFolders(const PictureFolders& folders);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_PICTURE_FILES_H_
