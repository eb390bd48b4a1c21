// The module ceres_ed._core, which has everything that `import ceres_ed` provides.
#include <ceres_ed/linear_algebra/linear_algebra_backend.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/version.h>

#include <pybind11/pybind11.h>

namespace py = pybind11;

PYBIND11_MODULE(_core, module) {
  module.doc() = "Embedded-deformation graphs on Ceres Solver.";
  module.attr("__version__") = ceres_ed::kVersion;
  // A class is bound before the functions that take or return it, so that their docstrings name it.
  ceres_ed::python::BindCloud(module);
  ceres_ed::python::BindEnergies(module);
  ceres_ed::python::BindPointEnergy(module);
  ceres_ed::python::BindGraph(module);
  ceres_ed::python::BindLandmarks(module);
  ceres_ed::python::BindWarp(module);
  ceres_ed::python::BindField(module);
  ceres_ed::python::BindFitOptions(module);
  ceres_ed::python::BindVerdict(module);
  ceres_ed::python::BindFitResult(module);
  ceres_ed::python::BindFit(module);
  ceres_ed::python::BindFitter(module);
  ceres_ed::python::BindEvaluate(module);
  ceres_ed::python::BindShapeStatistics(module);
  ceres_ed::python::BindFitReport(module);
  ceres_ed::python::BindRunReport(module);
  ceres_ed::python::BindTracker(module);
  ceres_ed::python::BindSequence(module);
  module.def(
      "backend",
      [] {
        const ceres_ed::LinearAlgebraBackend backend = ceres_ed::DescribeBackend();
        py::dict about;
        about["ceres"] = backend.ceres_version;
        about["sparse_library"] = backend.sparse_library;
        about["blas"] = backend.blas;
        about["ordering"] = backend.ordering_library;
        about["kernels"] = backend.kernels;
        return about;
      },
      "Returns the libraries with which this process solves: the version of Ceres, its sparse "
      "library, "
      "BLAS, the ordering library, and the instructions of the kernels.");
}
