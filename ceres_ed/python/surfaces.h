// Surfaces in Python: arrays, pairs of arrays, and objects of trimesh and Open3D.
#ifndef CERES_ED_PYTHON_SURFACES_H_
#define CERES_ED_PYTHON_SURFACES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/fit/named_landmarks.h>
#include <ceres_ed/pipeline/verdict.h>
#include <ceres_ed/preflight/finding.h>
#include <ceres_ed/python/colors.h>
#include <ceres_ed/registration/fit.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// The class Cloud: points, and the file from which they were read.
struct Cloud {
  PointCloud cloud;
  Colors colors;
  // Null if the points came from arrays.
  std::unique_ptr<LoadedCloud> file;
};

// The class FitResult: the result of a fit, its input, and how far to trust them.
struct FittedSurface {
  // Without the target, which is not needed any more.
  FitInput input;
  // The colours of the source.
  Colors colors;
  FitResult result;
  Verdict verdict;
  std::vector<Finding> checks;
  // Landmarks that are named on both surfaces, and how far each of them is off. If they draw the
  // fit, their constraints stand behind the first `num_by_index` landmarks of `input`.
  std::vector<LandmarkPair> landmark_pairs;
  std::vector<LandmarkError> landmark_errors;
  std::size_t num_by_index = 0;
};

// Reads a file. Raises an OSError if it cannot be read, and a ValueError with the library's
// sentence if its contents cannot be used.
Cloud LoadFile(const std::string& path);

// Returns whether an object is a path: a str or an os.PathLike.
bool IsPath(const pybind11::handle& object);

// A surface that exists during a call. The surface of a Cloud is shared; any other one is a copy.
class SurfaceArgument {
 public:
  // `object` is a Cloud, a FitResult, a pair (points, triangles), an object with `vertices` and
  // `faces` (trimesh) or `triangles` (Open3D), an object with `points`, an array of points, or the
  // path of a file. Raises a TypeError or a ValueError that names `what` for anything else.
  SurfaceArgument(const pybind11::object& object, const std::string& what);

  const PointCloud& operator*() const { return shared_ != nullptr ? *shared_ : own_; }
  // Returns the colours of the points; empty if there are none.
  const Colors& colors() const { return shared_colors_ != nullptr ? *shared_colors_ : own_colors_; }
  // The file from which the surface was read; null for arrays. It lives as long as this object.
  const PlyDocument* document() const { return document_; }
  // Returns a copy if the surface belongs to a Cloud, otherwise the surface itself.
  PointCloud Take() && {
    if (shared_ != nullptr) return *shared_;
    return std::move(own_);
  }

 private:
  // Keeps the Cloud alive.
  pybind11::object object_;
  const PointCloud* shared_ = nullptr;
  PointCloud own_;
  const Colors* shared_colors_ = nullptr;
  Colors own_colors_;
  const PlyDocument* document_ = nullptr;
  std::unique_ptr<LoadedCloud> own_file_;
};

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_SURFACES_H_
