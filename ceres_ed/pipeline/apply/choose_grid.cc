#include "ceres_ed/pipeline/apply/choose_grid.h"

#include <ceres_ed/io/field/grid_reader.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace ceres_ed {
namespace {

// Grid points for each distance of the nodes.
constexpr double kPointsPerNode = 4.0;
constexpr double kMostByDefault = 2e6;
constexpr double kBytesPerMegabyte = 1e6;

// Returns the number of points along each axis that cover `extent`.
Eigen::Array3d Sizes(const Eigen::Vector3d& extent, double spacing) {
  // An extent that is a whole number of spacings shall not gain a point by rounding.
  constexpr double kRounding = 1e-9;
  return (extent.array() / spacing - kRounding).ceil().max(0.0) + 1.0;
}

// Returns the smallest spacing, to two digits, that gives at most `most` points.
double FittingSpacing(const Eigen::Vector3d& extent, double spacing, double most) {
  double fitting = spacing;
  while (Sizes(extent, fitting).prod() > most) {
    const double step = std::pow(10.0, std::floor(std::log10(fitting)) - 1.0);
    const double growth = std::cbrt(Sizes(extent, fitting).prod() / most);
    // The cube root falls short where rounding up counts; the last steps are small ones.
    fitting = (std::floor(fitting * std::max(1.0, 0.98 * growth) / step) + 1.0) * step;
  }
  return fitting;
}

Status CheckSize(const FieldSettings& settings,
                 const FieldFormat& format,
                 const Eigen::Vector3d& extent,
                 double spacing,
                 const std::string& path) {
  const Eigen::Array3d sizes = Sizes(extent, spacing);
  const double megabytes = sizes.prod() * format.bytes_per_point / kBytesPerMegabyte;
  if (megabytes <= settings.max_mb && sizes.maxCoeff() <= std::numeric_limits<int>::max()) {
    return Status::Ok();
  }
  const double most = std::max(1.0, settings.max_mb * kBytesPerMegabyte / format.bytes_per_point);
  return Status::Error(
      path + ": a field with the spacing " + NumberText(spacing) + " has " +
      std::to_string(std::llround(std::min(megabytes, 1e15))) + " MB, expected at most " +
      NumberText(settings.max_mb) +
      " (--max_mb); --spacing=" + NumberText(FittingSpacing(extent, spacing, most)) + " would fit");
}

double DefaultSpacing(const FieldSubject& subject, const Eigen::Vector3d& extent) {
  constexpr double kPointsAlongDiagonal = 64.0;
  double spacing = subject.node_spacing > 0.0 ? subject.node_spacing / kPointsPerNode
                                              : extent.norm() / kPointsAlongDiagonal;
  constexpr double kGrowth = 1.01;
  while (spacing > 0.0 && Sizes(extent, spacing).prod() > kMostByDefault) spacing *= kGrowth;
  return spacing;
}

StatusOr<FieldGrid> GridOfImage(const FieldSettings& settings,
                                const FieldFormat& format,
                                const FileFrame& frame) {
  StatusOr<FieldGrid> grid = ReadGrid(settings.like);
  if (!grid.ok()) return grid.status();
  if (FieldMegabytes(format, *grid) > settings.max_mb) {
    return Status::Error(settings.like + ": a field on this grid has " +
                         std::to_string(std::llround(FieldMegabytes(format, *grid))) +
                         " MB, expected at most " + NumberText(settings.max_mb) + " (--max_mb)");
  }
  return ChangeFrame(*grid, FrameOfFile(FieldSpace::kLps, settings.frame, settings.unit), frame);
}

}  // namespace

double FieldMegabytes(const FieldFormat& format, const FieldGrid& grid) {
  return static_cast<double>(grid.num_points()) * format.bytes_per_point / kBytesPerMegabyte;
}

StatusOr<FieldGrid> ChooseGrid(const FieldSettings& settings,
                               const FieldFormat& format,
                               const FileFrame& frame,
                               const FieldSubject& subject) {
  if (!settings.like.empty()) return GridOfImage(settings, format, frame);
  const StatusOr<std::optional<Eigen::AlignedBox3d>> bounds = ParseBounds(settings.bounds);
  if (!bounds.ok()) return bounds.status();
  Eigen::AlignedBox3d box = subject.box;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(settings.margin * subject.node_spacing);
  if (bounds->has_value()) {
    box = **bounds;
  } else {
    box = Eigen::AlignedBox3d(box.min() - margin, box.max() + margin);
  }
  const Eigen::Vector3d extent = box.sizes();
  double spacing = settings.spacing;
  if (spacing == 0.0 && extent.allFinite()) spacing = DefaultSpacing(subject, extent);
  if (!(spacing > 0.0) || !extent.allFinite()) {
    return Status::Error(settings.field +
                         ": the warp has no extent from which the grid would follow, expected "
                         "--spacing and --bounds");
  }
  if (Status status = CheckSize(settings, format, extent, spacing, settings.field); !status.ok()) {
    return status;
  }
  const Eigen::Array3d sizes = Sizes(extent, spacing);
  FieldGrid grid;
  for (int axis = 0; axis < 3; ++axis) grid.size[axis] = static_cast<int>(sizes[axis]);
  grid.spacing.setConstant(spacing * frame.unit());
  grid.origin = frame.ToFile(box.center()) - 0.5 * spacing * frame.unit() * (sizes - 1.0).matrix();
  return grid;
}

}  // namespace ceres_ed
