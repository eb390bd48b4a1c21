// Files of named points: landmarks that somebody has set on a surface.
#ifndef CERES_ED_IO_LANDMARKS_LANDMARK_FILE_H_
#define CERES_ED_IO_LANDMARKS_LANDMARK_FILE_H_

#include <ceres_ed/util/status.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The directions of the axes x y z in the patient: left, posterior, superior (most files of
// meshes), or right, anterior, superior (inside 3D Slicer). They differ in the signs of x and y.
enum class AnatomicalSpace { kUnknown, kLps, kRas };

// A landmark and its name.
struct NamedLandmark {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// Which columns of a table with two points a row are read: source_x ..., or target_x ...
enum class LandmarkSide { kSource, kTarget };

// The landmarks of a file, and all else that it takes to write it again.
struct LandmarkFile {
  // At least one. Positions are as in the file; names are not empty and differ. A point without a
  // name has its number, counted from 1.
  std::vector<NamedLandmark> points;
  // What the file says.
  AnatomicalSpace space = AnatomicalSpace::kUnknown;
  // What was left out or guessed, a sentence for each kind.
  std::vector<std::string> warnings;

  // The contents of the file.
  std::string text;
  // The place of the coordinates of each point in a file that is no JSON.
  struct Place {
    std::size_t begin = 0;
    std::size_t size = 0;
  };
  std::vector<std::array<Place, 3>> places;
  // In a JSON file: the path to the list of the coordinates of each point (RFC 6901).
  std::vector<std::string> pointers;
};

// Returns whether files with the ending of `path` hold landmarks: .json (markups of 3D Slicer, and
// Scalismo's), .fcsv, .pts or .csv.
bool HasLandmarkEnding(const std::string& path);

// Reads the landmarks of the file `path`:
//   - .json (.mrk.json): control points of 3D Slicer's markups, or Scalismo's list of id and
//     coordinates;
//   - .fcsv: fiducials of 3D Slicer;
//   - .pts: lines `x y z` or `name x y z`; the first lines of IDAV Landmark and of ibug are known;
//   - .csv and all others: rows `name,x,y,z`, or with a header that names the columns `label` (or
//     `name`, `id`) and x y z, l p s, r a s, or source_x ... and target_x ...
// A point that is not defined (in Slicer) is left out with a warning. Errors name the file, the
// place, the value and what was expected.
StatusOr<LandmarkFile> ReadLandmarkFile(const std::string& path,
                                        LandmarkSide side = LandmarkSide::kSource);

// Writes `file` to `path` with other positions, one for each point; all else is as it was.
Status WriteLandmarkFile(const std::string& path,
                         const LandmarkFile& file,
                         const std::vector<Eigen::Vector3d>& positions);

// Writes `points` to a new file in the format of the ending of `path`: .json is markups of 3D
// Slicer, .fcsv its old fiducials, .pts rows `name x y z`, and .csv rows below a header that names
// the axes. Names are not empty and differ, and `space` says how the positions are written. The
// error says which name the format can't hold, and that 3D Slicer's formats need a known space.
Status WriteNewLandmarkFile(const std::string& path,
                            const std::vector<NamedLandmark>& points,
                            AnatomicalSpace space);

// Returns `position` with x and y turned if `from` and `to` are known and differ.
Eigen::Vector3d BetweenSpaces(const Eigen::Vector3d& position,
                              AnatomicalSpace from,
                              AnatomicalSpace to);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_LANDMARKS_LANDMARK_FILE_H_
