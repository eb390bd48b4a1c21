#include "ceres_ed/io/field/grid_reader.h"

#include <ceres_ed/util/options.h>

#include <algorithm>
#include <cmath>

namespace ceres_ed {
namespace {

struct GridFormat {
  const char* ending;
  StatusOr<FieldGrid> (*read)(const std::string& path);
};

constexpr GridFormat kFormats[] = {
    {".nrrd", ReadNrrdGrid},
    {".nhdr", ReadNrrdGrid},
    {".nii", ReadNiftiGrid},
    {".nii.gz", ReadNiftiGrid},
    {".mha", ReadMetaImageGrid},
    {".mhd", ReadMetaImageGrid},
};

}  // namespace

StatusOr<FieldGrid> ReadGrid(const std::string& path) {
  std::string name = path;
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  std::string endings;
  for (const GridFormat& format : kFormats) {
    const std::string ending = format.ending;
    if (name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending) {
      return format.read(path);
    }
    endings += (endings.empty() ? "" : ", ") + ending;
  }
  return Status::Error(path + ": unknown format of an image, expected a name that ends with one " +
                       "of " + endings);
}

StatusOr<FieldGrid> GridFromSteps(const std::string& path,
                                  const std::array<double, 3>& sizes,
                                  const Eigen::Vector3d& origin,
                                  const Eigen::Matrix3d& steps) {
  constexpr double kLargest = 1e6;
  // Headers have few digits.
  constexpr double kMostSkew = 1e-3;
  FieldGrid grid;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = sizes[axis];
    if (!(size >= 1.0 && size <= kLargest && size == std::floor(size))) {
      return Status::Error(path + ": " + NumberText(size) + " points along an axis, expected a " +
                           "whole number from 1 to 1e6");
    }
    grid.size[axis] = static_cast<int>(size);
    const double spacing = steps.col(axis).norm();
    if (!(spacing > 0.0 && std::isfinite(spacing))) {
      return Status::Error(path + ": the spacing " + NumberText(spacing) +
                           ", expected a finite number > 0");
    }
    grid.spacing[axis] = spacing;
    grid.direction.col(axis) = steps.col(axis) / spacing;
  }
  if (!origin.allFinite()) {
    return Status::Error(path + ": an origin that is not finite, expected three numbers");
  }
  grid.origin = origin;
  const Eigen::Matrix3d products = grid.direction.transpose() * grid.direction;
  if (!products.isIdentity(kMostSkew)) {
    return Status::Error(path +
                         ": the axes are not at right angles, expected a grid without shear");
  }
  return grid;
}

}  // namespace ceres_ed
