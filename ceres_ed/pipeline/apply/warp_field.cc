#include "ceres_ed/pipeline/apply/warp_field.h"

#include <ceres_ed/graph/inverse_warp.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// A search for an inverse ends at this residual, in spacings. In a file it is lost to rounding.
constexpr double kTolerance = 1e-6;
// A point that is farther from its image has no inverse, in spacings.
constexpr double kMostResidual = 0.5;

void Store(const Eigen::Vector3d& vector, std::size_t index, DisplacementField* field) {
  for (int c = 0; c < 3; ++c) field->vectors[3 * index + c] = static_cast<float>(vector[c]);
}

// Calls fill(j, k) for each row of the grid, slice after slice. Returns false if the observer has
// stopped the run.
bool ForEachRow(const FieldGrid& grid,
                int num_threads,
                RunObserver* observer,
                const std::function<void(int j, int k)>& fill) {
  for (int k = 0; k < grid.size[2]; ++k) {
    if (observer->ShouldStop()) return false;
    observer->OnProgress(k, grid.size[2], "field");
    ParallelFor(num_threads, grid.size[1], [&](int begin, int end) {
      for (int j = begin; j < end; ++j) fill(j, k);
    });
  }
  observer->OnProgress(grid.size[2], grid.size[2], "field");
  return true;
}

DisplacementField EmptyField(const FieldGrid& grid) {
  DisplacementField field;
  field.grid = grid;
  field.vectors.resize(3 * grid.num_points());
  return field;
}

// The quality of the points of one row.
struct RowQuality {
  double sum_of_residuals = 0.0;
  double max_residual = 0.0;
  std::size_t num_found = 0;
  std::size_t num_folded = 0;
};

InverseQuality Summary(const std::vector<RowQuality>& rows, std::size_t num_points) {
  InverseQuality quality;
  std::size_t num_found = 0;
  for (const RowQuality& row : rows) {
    quality.mean_residual += row.sum_of_residuals;
    quality.max_residual = std::max(quality.max_residual, row.max_residual);
    quality.num_folded += row.num_folded;
    num_found += row.num_found;
  }
  if (num_found > 0) quality.mean_residual /= static_cast<double>(num_found);
  quality.num_without = num_points - num_found;
  return quality;
}

// Returns what the field has at a point without an inverse; `nearest` is what the search found.
Eigen::Vector3d WithoutInverse(NoInverse rule, const Eigen::Vector3d& nearest) {
  switch (rule) {
    case NoInverse::kNan:
      return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    case NoInverse::kZero:
      return Eigen::Vector3d::Zero();
    case NoInverse::kNearest:
      return nearest;
  }
  return nearest;
}

}  // namespace

std::optional<DisplacementField> FillForwardField(const SpaceWarp& warp,
                                                  const FieldGrid& grid,
                                                  const FileFrame& frame,
                                                  int num_threads,
                                                  RunObserver* observer) {
  DisplacementField field = EmptyField(grid);
  const auto fill = [&](int j, int k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const Eigen::Vector3d point = frame.FromFile(grid.Position(i, j, k));
      Store(frame.ToFile(warp(point) - point), grid.Index(i, j, k), &field);
    }
  };
  if (!ForEachRow(grid, num_threads, observer, fill)) return std::nullopt;
  return field;
}

std::optional<DisplacementField> FillInverseField(const SpaceWarp& warp,
                                                  const FieldGrid& grid,
                                                  const FileFrame& frame,
                                                  NoInverse no_inverse,
                                                  int num_threads,
                                                  RunObserver* observer,
                                                  InverseQuality* quality) {
  DisplacementField field = EmptyField(grid);
  // In the unit of the surfaces.
  const double spacing = grid.spacing.minCoeff() / frame.unit();
  const InverseWarp inverse(warp, kTolerance * spacing);
  std::vector<RowQuality> rows(static_cast<std::size_t>(grid.size[1]) *
                               static_cast<std::size_t>(grid.size[2]));
  const auto fill = [&](int j, int k) {
    RowQuality& row = rows[grid.Index(0, j, k) / static_cast<std::size_t>(grid.size[0])];
    for (int i = 0; i < grid.size[0]; ++i) {
      const Eigen::Vector3d point = frame.FromFile(grid.Position(i, j, k));
      const InversePoint found = inverse.Find(point);
      const double residual = found.residual / spacing;
      Eigen::Vector3d displacement = found.point - point;
      if (residual <= kMostResidual) {
        ++row.num_found;
        row.num_folded += found.is_folded ? 1 : 0;
        row.sum_of_residuals += residual;
        row.max_residual = std::max(row.max_residual, residual);
      } else {
        displacement = WithoutInverse(no_inverse, displacement);
      }
      Store(frame.ToFile(displacement), grid.Index(i, j, k), &field);
    }
  };
  if (!ForEachRow(grid, num_threads, observer, fill)) return std::nullopt;
  *quality = Summary(rows, grid.num_points());
  return field;
}

std::optional<Eigen::Vector3d> InterpolateField(const DisplacementField& field,
                                                const Eigen::Vector3d& point) {
  const FieldGrid& grid = field.grid;
  const Eigen::Vector3d at =
      (grid.direction.transpose() * (point - grid.origin)).cwiseQuotient(grid.spacing);
  std::array<int, 3> low;
  Eigen::Vector3d share;
  for (int axis = 0; axis < 3; ++axis) {
    const int last = grid.size[axis] - 1;
    if (!(at[axis] >= 0.0 && at[axis] <= last)) return std::nullopt;
    low[axis] = std::min(static_cast<int>(at[axis]), std::max(0, last - 1));
    share[axis] = at[axis] - low[axis];
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> step = {corner & 1, (corner >> 1) & 1, corner >> 2};
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] ? share[axis] : 1.0 - share[axis];
    // Of a grid with one point along an axis there is no second one.
    if (weight == 0.0) continue;
    const std::size_t index = grid.Index(low[0] + step[0], low[1] + step[1], low[2] + step[2]);
    for (int c = 0; c < 3; ++c) sum[c] += weight * field.vectors[3 * index + c];
  }
  if (!sum.allFinite()) return std::nullopt;
  return sum;
}

FieldError MeasureField(const DisplacementField& field,
                        const FileFrame& frame,
                        const std::vector<Eigen::Vector3d>& from,
                        const std::vector<Eigen::Vector3d>& to) {
  CHECK_EQ(from.size(), to.size());
  FieldError error;
  for (std::size_t p = 0; p < from.size(); ++p) {
    const Eigen::Vector3d start = frame.ToFile(from[p]);
    const std::optional<Eigen::Vector3d> displacement = InterpolateField(field, start);
    if (!displacement.has_value()) continue;
    const double missed =
        (start + *displacement - frame.ToFile(to[p])).norm() / field.grid.spacing.minCoeff();
    error.mean += missed;
    error.max = std::max(error.max, missed);
    ++error.num_points;
  }
  if (error.num_points > 0) error.mean /= static_cast<double>(error.num_points);
  return error;
}

}  // namespace ceres_ed
