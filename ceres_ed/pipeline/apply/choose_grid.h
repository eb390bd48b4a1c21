// The grid of a field that is written.
#ifndef CERES_ED_PIPELINE_APPLY_CHOOSE_GRID_H_
#define CERES_ED_PIPELINE_APPLY_CHOOSE_GRID_H_

#include <ceres_ed/io/field/field_format.h>
#include <ceres_ed/pipeline/apply/field_settings.h>
#include <ceres_ed/pipeline/apply/file_frame.h>
#include <ceres_ed/util/status.h>

#include <Eigen/Geometry>

namespace ceres_ed {

// The surface around which a grid lies, in its own coordinates.
struct FieldSubject {
  Eigen::AlignedBox3d box;
  // The distance of the nodes on it, or 0 if there is only one node.
  double node_spacing = 0.0;
};

// Returns the grid that `settings` ask for, in the coordinates of the file: that of --like, else a
// grid along the axes of the box of --bounds, else along those of the subject's box with the
// margin. The grid covers the box and has the same centre. The error says what was expected, and if
// the field is too large, which spacing would fit.
StatusOr<FieldGrid> ChooseGrid(const FieldSettings& settings,
                               const FieldFormat& format,
                               const FileFrame& frame,
                               const FieldSubject& subject);

// Returns the size of the file before compression, in MB.
double FieldMegabytes(const FieldFormat& format, const FieldGrid& grid);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_APPLY_CHOOSE_GRID_H_
