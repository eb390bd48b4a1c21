// Names and sizes of image files.
#ifndef CERES_ED_IO_SEQUENCE_PICTURE_FILES_H_
#define CERES_ED_IO_SEQUENCE_PICTURE_FILES_H_

#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <optional>
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

// Returns a sentence if the PNG files of depth have 8 bits, which hold no more than 255 units;
// otherwise an empty text.
std::string ShortDepthWarning(const std::string& path, double units_per_metre);

// Sets the camera's size from the first frame whose depth can be read. It is an error if there is
// none.
Status SetSizeFromPictures(const std::vector<SequenceEntry>& entries, PinholeCamera* camera);

// Returns the time in seconds if a name without ending is one: seconds with a fraction
// (1551915398.6757), or milli-, micro- or nanoseconds as a whole number of at least 11 digits that
// does not begin with 0.
std::optional<double> TimeInName(const std::string& stem);

// Returns the pictures of a folder (PNG, and JPEG unless `lossless_only`) by the number in the
// digits at the end of their names. Adds a warning if there are names without a number. It is an
// error if two files have the same number or if the folder can't be listed. If `times` is not null
// and every name is a time, pictures are numbered from 0 in the order of time, and the times are
// written to `times`; for a further folder, `times` has those of the first one, and its pictures
// get the number of the nearest time within 0.02 s.
StatusOr<std::map<int, std::string>> ListNumberedPictures(const std::string& folder,
                                                          bool lossless_only,
                                                          std::vector<std::string>* warnings,
                                                          std::vector<double>* times = nullptr);

// The paths of folders of numbered images; empty if there is none.
struct PictureFolders {
  std::string depth;
  // Of a stereo camera, the left pictures.
  std::string color;
  std::string right;
  std::string mask;
};

// Returns the frames of the folders: one for each number of a depth image. The time of a frame is
// its number. It is an error if there is no depth folder, if it has no image, or if two files have
// the same number.
StatusOr<SequenceListing> ListPictureFolders(const PictureFolders& folders);

// Returns the frames of a stereo sequence: one for each number with a left and a right picture.
// Depth is optional; the frames have it only if all of them do. Pictures without a partner give a
// warning. It is an error if a folder is missing or has no picture, if no number has both, or if
// two files have the same number. The caller adds the calibration.
StatusOr<SequenceListing> ListStereoFolders(const PictureFolders& folders);

// Sets the size of both cameras from the first left picture that can be read, as calibrations often
// do not give it. It is an error if there is none, or if a principal point is so far outside of the
// picture that the calibration cannot belong to it.
Status SetSizeFromPicture(const SequenceListing& listing, StereoRig* rig);

// Adds the poses of a file `frame tx ty tz qx qy qz qw`, if there is one, to the frames with these
// numbers.
Status AddPosesFile(const std::string& path, SequenceListing* listing);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_PICTURE_FILES_H_
