// The annotation of STIR: where points of the tissue are in the first and in the last frame.
#ifndef CERES_ED_IO_SEQUENCE_LAYOUTS_STIR_TRUTH_H_
#define CERES_ED_IO_SEQUENCE_LAYOUTS_STIR_TRUTH_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/util/status.h>

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The points of the left camera, in pixels. Which point of the end belongs to a point of the start
// is not known.
struct StirPoints {
  // The folder of the clip, left*/seqNN, which is its name in the files of the challenge.
  std::string clip;
  std::vector<Eigen::Vector2d> start;
  // Empty if the end is not given.
  std::vector<Eigen::Vector2d> end;
};

// Reads segmentation/icgstartseg.png and icgendseg.png of the clip in a folder that has the layout
// `stir`. Nothing if the folder has another layout or the first of these files is not there. The
// error names the file.
StatusOr<std::optional<StirPoints>> ReadStirPoints(const std::string& directory);

// Returns the middle of the bounding box of each white region, in the order of their first pixels
// row by row. Pixels that touch at a corner belong together.
std::vector<Eigen::Vector2d> RegionCenters(const MaskImage& mask);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_LAYOUTS_STIR_TRUTH_H_
