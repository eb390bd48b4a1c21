// Parsers of the formats of landmark_file.h. Each fills points, space, warnings and the places from
// `file->text`; whether the names are good is checked afterwards.
#ifndef CERES_ED_IO_LANDMARKS_LANDMARK_PARSERS_H_
#define CERES_ED_IO_LANDMARKS_LANDMARK_PARSERS_H_

#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the ending of a file's name in lower case, for example ".json".
std::string LandmarkEnding(const std::string& path);

Status ParseLandmarkJson(const std::string& path, LandmarkFile* file);
Status ParseFcsv(const std::string& path, LandmarkFile* file);
Status ParsePts(const std::string& path, LandmarkFile* file);
Status ParseLandmarkCsv(const std::string& path, LandmarkSide side, LandmarkFile* file);

// Returns the text of a JSON file with these coordinates at file.pointers.
std::string EncodeLandmarkJson(const LandmarkFile& file,
                               const std::vector<Eigen::Vector3d>& positions);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_LANDMARKS_LANDMARK_PARSERS_H_
