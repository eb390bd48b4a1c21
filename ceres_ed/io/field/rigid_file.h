// Placements as files for other tools.
#ifndef CERES_ED_IO_FIELD_RIGID_FILE_H_
#define CERES_ED_IO_FIELD_RIGID_FILE_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes b_from_a as a 4 x 4 matrix in four lines of text: a point p of frame a, as the column (p,
// 1), is moved to the matrix times p.
Status WriteMatrixFile(const std::string& path, const Similarity& b_from_a);

// Writes `transform` as an ITK transform file in text, with the type AffineTransform_double_3_3: a
// point p is mapped to transform * p. ITK resamples an image with the transform that maps points of
// the result to points of the image.
Status WriteItkTransformFile(const std::string& path,
                             const Similarity& transform,
                             const std::string& description);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_RIGID_FILE_H_
