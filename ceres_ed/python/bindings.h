// The parts of the module. Each is defined in the file of its name.
#ifndef CERES_ED_PYTHON_BINDINGS_H_
#define CERES_ED_PYTHON_BINDINGS_H_

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

void BindCloud(pybind11::module_& module);
void BindEnergies(pybind11::module_& module);
void BindPointEnergy(pybind11::module_& module);
void BindGraph(pybind11::module_& module);
void BindLandmarks(pybind11::module_& module);
void BindWarp(pybind11::module_& module);
void BindField(pybind11::module_& module);
void BindFitOptions(pybind11::module_& module);
void BindVerdict(pybind11::module_& module);
void BindFitResult(pybind11::module_& module);
void BindFit(pybind11::module_& module);
void BindFitter(pybind11::module_& module);
void BindEvaluate(pybind11::module_& module);
void BindSequence(pybind11::module_& module);
void BindShapeStatistics(pybind11::module_& module);
void BindFitReport(pybind11::module_& module);
void BindRunReport(pybind11::module_& module);
void BindTrackerOptions(pybind11::module_& module);
void BindTracker(pybind11::module_& module);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_BINDINGS_H_
