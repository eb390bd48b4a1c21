#include "ceres_ed/pipeline/apply/file_frame.h"

namespace ceres_ed {
namespace {

double MillimetresIn(SurfaceUnit unit) {
  switch (unit) {
    case SurfaceUnit::kMillimetres:
      return 1.0;
    case SurfaceUnit::kCentimetres:
      return 10.0;
    case SurfaceUnit::kMetres:
      return 1000.0;
  }
  return 1.0;
}

}  // namespace

FileFrame FrameOfFile(FieldSpace space, SurfaceAxes axes, SurfaceUnit unit) {
  FileFrame frame;
  if (space == FieldSpace::kAny) return frame;
  // Right and left, and front and back, differ by a sign.
  if (axes == SurfaceAxes::kRas) frame.factors = {-1.0, -1.0, 1.0};
  frame.factors *= MillimetresIn(unit);
  return frame;
}

FieldGrid ChangeFrame(const FieldGrid& grid, const FileFrame& from, const FileFrame& to) {
  const Eigen::Vector3d factors = to.factors.cwiseQuotient(from.factors);
  FieldGrid changed = grid;
  changed.origin = factors.cwiseProduct(grid.origin);
  // All factors have the same magnitude.
  changed.spacing *= factors.z();
  changed.direction = factors.cwiseQuotient(factors.cwiseAbs()).asDiagonal() * grid.direction;
  return changed;
}

}  // namespace ceres_ed
