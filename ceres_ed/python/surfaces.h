// Surfaces as Python has them: arrays, pairs of arrays, objects of trimesh and Open3D.
#ifndef CERES_ED_PYTHON_SURFACES_H_
#define CERES_ED_PYTHON_SURFACES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/registration/fit.h>

#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// The class Cloud: points, with the file that they came from where there is one.
struct Cloud {
  PointCloud cloud;
  // Null where it came from arrays.
  std::unique_ptr<LoadedCloud> file;
};

// The class FitResult: what was found, and what it was found for.
struct FittedSurface {
  FitInput input;
  FitResult result;
};

// A surface for as long as a call takes: of a Cloud its own, of anything else a copy.
class SurfaceArgument {
 public:
  // `object` is a Cloud, a FitResult, (points, triangles), an object with `vertices` and `faces`
  // (trimesh) or `triangles` (Open3D), one with `points`, or an array of points. TypeError or
  // ValueError, naming `what`, on anything else.
  SurfaceArgument(const pybind11::object& object, const std::string& what);

  const PointCloud& operator*() const { return shared_ != nullptr ? *shared_ : own_; }
  // A copy of what belongs to a Cloud, else the surface itself.
  PointCloud Take() && { return shared_ != nullptr ? *shared_ : std::move(own_); }

 private:
  // Keeps the Cloud alive.
  pybind11::object object_;
  const PointCloud* shared_ = nullptr;
  PointCloud own_;
};

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_SURFACES_H_
