// What the function fit() and the class SurfaceFitter share.
#ifndef CERES_ED_PYTHON_FITS_H_
#define CERES_ED_PYTHON_FITS_H_

#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/callbacks.h>
#include <ceres_ed/python/energies.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/surfaces.h>
#include <ceres_ed/registration/fit.h>

#include <functional>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// Returns landmarks from {source point: (x, y, z)} or from a pair (source points, positions).
// Raises a TypeError for anything else, and a ValueError for unequal numbers.
std::vector<Landmark> ToLandmarks(const pybind11::object& object);

// The files from which source and target were read; null for arrays.
struct Documents {
  const PlyDocument* source = nullptr;
  const PlyDocument* target = nullptr;
};

// Landmarks that are named on both surfaces, as fit() takes them. The objects are None, or anything
// that ToNamedLandmarks() takes.
struct NamedArguments {
  pybind11::object source;
  pybind11::object target;
  // 'fit' or 'measure'.
  std::string use;
  // 'auto', 'LPS' or 'RAS': the space of both surfaces.
  std::string mesh_space;
};

// Matches them by name, and adds to `fitted` the pairs and, if they draw the fit, their
// constraints. Returns sentences about landmarks that were left out or lie far from their surface.
// Raises a ValueError for bad ones, and if only one of both is given.
std::vector<std::string> AddNamedLandmarks(const NamedArguments& arguments,
                                           const Documents& documents,
                                           FittedSurface* fitted);

// Looks at `fitted->input`, and measures and judges the result of its fit, without the
// interpreter's lock. `initial_scale` is by what the source was multiplied before anything else.
// Does nothing if the fit is an error.
void Judge(const Documents& documents,
           double initial_scale,
           const std::function<bool()>& should_stop,
           const StatusOr<FitResult>& result,
           FittedSurface* fitted);

// Stores the result of a fit of `fitted->input`, whose target is not kept, with `warnings` ahead of
// its own. Raises a ValueError for an error, and a RuntimeError for a result that cannot be used.
void Conclude(StatusOr<FitResult> result,
              const std::vector<std::string>& warnings,
              FittedSurface* fitted);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_FITS_H_
