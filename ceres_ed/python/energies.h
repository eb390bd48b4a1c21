// Energies as Python has them.
#ifndef CERES_ED_PYTHON_ENERGIES_H_
#define CERES_ED_PYTHON_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>

#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// From None, a text as of --energy, an Energy, or a sequence of texts and Energies. ValueError on a
// text that can't be read.
std::vector<EnergySpec> ToEnergies(const pybind11::object& energies);

// The energies of the library and of `plugins`: None, a path or a sequence of paths. OSError on a
// file that can't be read, ValueError on one that is no plugin of this library.
EnergyRegistry MakeRegistry(const pybind11::object& plugins);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_ENERGIES_H_
