// The coordinates of a file against those of the surfaces.
#ifndef CERES_ED_PIPELINE_APPLY_FILE_FRAME_H_
#define CERES_ED_PIPELINE_APPLY_FILE_FRAME_H_

#include <ceres_ed/io/field/field_format.h>
#include <ceres_ed/pipeline/apply/field_settings.h>

#include <Eigen/Core>

namespace ceres_ed {

// A sign and a unit for each axis: a point p of a surface is factors * p (axis by axis) in the
// file. Displacements are taken over in the same way.
struct FileFrame {
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();

  Eigen::Vector3d ToFile(const Eigen::Vector3d& point) const { return factors.cwiseProduct(point); }
  Eigen::Vector3d FromFile(const Eigen::Vector3d& point) const {
    return point.cwiseQuotient(factors);
  }
  // The length in the file of the unit of the surfaces.
  double unit() const { return factors.z(); }
};

// Returns the frame of a file whose readers expect `space`, for surfaces in these axes and unit.
FileFrame FrameOfFile(FieldSpace space, SurfaceAxes axes, SurfaceUnit unit);

// Returns `grid`, whose coordinates are those of `from`, in those of `to`. No point moves, and the
// indices stay the same.
FieldGrid ChangeFrame(const FieldGrid& grid, const FileFrame& from, const FileFrame& to);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_APPLY_FILE_FRAME_H_
