// The grids of medical images.
#ifndef CERES_ED_IO_FIELD_GRID_READER_H_
#define CERES_ED_IO_FIELD_GRID_READER_H_

#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <string>

#include <Eigen/Core>

namespace ceres_ed {

// Reads the grid of an image with three dimensions from its header: .nrrd, .nhdr, .nii, .nii.gz,
// .mha or .mhd. The result is in left-posterior-superior coordinates in mm, as ITK has it. The
// error names the file, what is missing or bad, and what was expected.
StatusOr<FieldGrid> ReadGrid(const std::string& path);

// Returns the grid whose axes go in steps of the columns of `steps`. The error says which number is
// bad, or that the axes are not at right angles. `path` is for messages.
StatusOr<FieldGrid> GridFromSteps(const std::string& path,
                                  const std::array<double, 3>& sizes,
                                  const Eigen::Vector3d& origin,
                                  const Eigen::Matrix3d& steps);

// The readers of the formats.
StatusOr<FieldGrid> ReadNrrdGrid(const std::string& path);
StatusOr<FieldGrid> ReadMetaImageGrid(const std::string& path);
StatusOr<FieldGrid> ReadNiftiGrid(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_GRID_READER_H_
