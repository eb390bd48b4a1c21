// Names and sizes of picture files.
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

// Returns whether `path` is a folder (or a file), links followed.
bool IsFolder(const std::string& path);
bool IsFile(const std::string& path);

// Returns whether there is nothing in a folder.
bool IsEmptyFolder(const std::string& path);

// Returns width and height of a depth picture in pixels, from its header where it is a PNG, or an
// error as of ReadDepthImage.
StatusOr<std::pair<int, int>> ReadPictureSize(const std::string& path);

// Sets the camera's size from the first frame whose picture can be read; an error when there is
// none.
Status SetSizeFromPictures(const std::vector<SequenceEntry>& entries, PinholeCamera* camera);

// Folders of numbered pictures; paths, empty where there is none.
struct PictureFolders {
  std::string depth;
  std::string color;
  std::string mask;
};

// Returns the frames of the folders: one for each number of a depth picture, with the time set to
// the number. Errors: no depth folder, no picture in it, two files of a number.
StatusOr<SequenceListing> ListPictureFolders(const PictureFolders& folders);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_PICTURE_FILES_H_
