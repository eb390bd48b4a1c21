// Fills a grid with the displacements of a warp, or with those of its inverse.
#ifndef CERES_ED_PIPELINE_APPLY_WARP_FIELD_H_
#define CERES_ED_PIPELINE_APPLY_WARP_FIELD_H_

#include <ceres_ed/graph/space_warp.h>
#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/pipeline/apply/field_settings.h>
#include <ceres_ed/pipeline/apply/file_frame.h>
#include <ceres_ed/pipeline/run_observer.h>

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// How well the points of an inverse field are inverted. A point has an inverse if the search has
// found a point that the warp moves to within half a spacing: a field says no more than that.
struct InverseQuality {
  // The distances |W(x) - y| of points with an inverse, in spacings.
  double mean_residual = 0.0;
  double max_residual = 0.0;
  // The points of the grid without an inverse, and those at which the warp is folded, so that they
  // have several ones.
  std::size_t num_without = 0;
  std::size_t num_folded = 0;
};

// Fills the grid with W(p) - p, where p is a point of the grid and W is `warp`. The grid and the
// displacements are in the coordinates of the file (`frame`). Returns nothing if the observer stops
// the run. The result does not depend on `num_threads`.
std::optional<DisplacementField> FillForwardField(const SpaceWarp& warp,
                                                  const FieldGrid& grid,
                                                  const FileFrame& frame,
                                                  int num_threads,
                                                  RunObserver* observer);

// Does the same with W^-1(p) - p (graph/inverse_warp.h).
std::optional<DisplacementField> FillInverseField(const SpaceWarp& warp,
                                                  const FieldGrid& grid,
                                                  const FileFrame& frame,
                                                  NoInverse no_inverse,
                                                  int num_threads,
                                                  RunObserver* observer,
                                                  InverseQuality* quality);

// Returns the displacement at a point between those of the grid, by linear interpolation as tools
// do it; nothing outside the grid, and where a value is not a number.
std::optional<Eigen::Vector3d> InterpolateField(const DisplacementField& field,
                                                const Eigen::Vector3d& point);

// How far an interpolated field misses where it should lead, in spacings.
struct FieldError {
  double mean = 0.0;
  double max = 0.0;
  // The points at which the field has a value.
  std::size_t num_points = 0;
};

// Returns the error of a field that should lead from each point of `from` to the one of `to`. Both
// are in the coordinates of the surfaces.
FieldError MeasureField(const DisplacementField& field,
                        const FileFrame& frame,
                        const std::vector<Eigen::Vector3d>& from,
                        const std::vector<Eigen::Vector3d>& to);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_APPLY_WARP_FIELD_H_
