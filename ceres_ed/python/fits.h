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

// Looks at `fitted->input` and judges the result of its fit, without the interpreter's lock. Does
// nothing if the fit is an error.
void Judge(const Documents& documents,
           const std::function<bool()>& should_stop,
           const StatusOr<FitResult>& result,
           FittedSurface* fitted);

// Stores the result of a fit of `fitted->input`, whose target is not kept. Raises a ValueError for
// an error, and a RuntimeError for a result that cannot be used.
void Conclude(StatusOr<FitResult> result, FittedSurface* fitted);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_FITS_H_
