// What the readers of layouts have in common: names of files, sizes of pictures, videos.
#ifndef CERES_ED_IO_SEQUENCE_LAYOUTS_LAYOUT_FILES_H_
#define CERES_ED_IO_SEQUENCE_LAYOUTS_LAYOUT_FILES_H_

#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/sequence/picture_source.h>
#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/io/video/stacking.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// Returns the names of the files in a folder, sorted; hidden ones are left out. There are none if
// the folder can't be listed.
std::vector<std::string> FileNames(const std::string& folder);

// The same for the folders in a folder.
std::vector<std::string> FolderNames(const std::string& folder);

// Returns the files of a folder whose names end in digits and `suffix`, such as 000123l.png for
// "l.png", by number. Of several files with the same number the first one by name counts.
std::map<int, std::string> FilesByNumber(const std::string& folder, const std::string& suffix);

// Adds masks to the frames of the same number. Where there is about one mask for two frames, a
// frame without one gets that of the frame before, and a warning says so.
void AddMasksByNumber(const std::map<int, std::string>& masks, SequenceListing* listing);

// A file of a folder, with the time that its name gives.
struct TimedPicture {
  double time_s = 0.0;
  std::string path;
};

// Returns the files whose names have one of the endings, in the order of the numbers or times in
// their names; time_s is that time in seconds, or the number.
std::vector<TimedPicture> PicturesInOrder(const std::string& folder,
                                          const std::vector<std::string>& endings);

// Returns the paths of the videos in a folder, sorted.
std::vector<std::string> VideosIn(const std::string& folder);

// Returns the first of the names that is a file of `folder`, with the folder; otherwise "".
std::string FirstFile(const std::string& folder, const std::vector<std::string>& names);

// Returns width and height of a picture, or of the part of it that counts.
StatusOr<std::pair<int, int>> ReadSourceSize(const PictureSource& source);

// Returns the error "PATH: not there, expected FORM" for a calibration of a layout.
Status MissingCalibration(const std::string& path, const std::string& form);

// Makes a calibration, read from `path`, that of pictures of `width` x `height`. If it is for
// another size with the same ratio of width to height, its intrinsics are scaled and a remark says
// so; any other size is an error. So is a principal point outside the picture, if the file gives no
// size: the calibration then belongs to pictures of another size.
Status FitCalibration(const std::string& path,
                      int width,
                      int height,
                      StereoCalibration* calibration);

// The same for one camera without a size.
Status FitCamera(const std::string& path, int width, int height, PinholeCamera* camera);

// Reads camera.txt of a folder, if there is one: it replaces the camera that a layout assumes.
// Returns whether it was there.
StatusOr<bool> UseCameraFile(const std::string& directory, PinholeCamera* camera);

// Sets rig, camera and warnings of a listing from a calibration.
void SetCalibration(const StereoCalibration& calibration, SequenceListing* listing);

// The pictures of one frame of a stereo video.
struct StereoSources {
  PictureSource left;
  PictureSource right;
};

// Returns the two pictures of a frame of a stacked video.
StereoSources SourcesInVideo(const std::string& path, Stacking stacking, int video_frame);

// Appends the frames of a stacked video, numbered from `first_number`.
Status AddStackedVideo(const std::string& path,
                       Stacking stacking,
                       int first_number,
                       SequenceListing* listing);

// Appends the frames of two videos, which have the same number of frames; otherwise those that both
// have, and a warning.
Status AddTwoVideos(const std::string& left,
                    const std::string& right,
                    int first_number,
                    SequenceListing* listing);

// Guesses how the first frame of a video holds two pictures of `width` x `height` (0: unknown), and
// adds a warning that says so.
StatusOr<Stacking> FindStacking(const std::string& path,
                                int width,
                                int height,
                                SequenceListing* listing);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_LAYOUTS_LAYOUT_FILES_H_
