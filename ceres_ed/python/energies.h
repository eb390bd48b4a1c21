// Converts energies from Python.
#ifndef CERES_ED_PYTHON_ENERGIES_H_
#define CERES_ED_PYTHON_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>

#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// Returns energies from None, a text as in --energy, an Energy, or a sequence of texts and
// Energies. Raises a ValueError for a text that cannot be parsed, and a TypeError for anything
// else.
std::vector<EnergySpec> ToEnergies(const pybind11::object& energies);

// Returns the energies of the library and of `plugins`: None, a path or a sequence of paths. Raises
// an OSError if a file cannot be read, and a ValueError if it is not a plugin of this library.
EnergyRegistry MakeRegistry(const pybind11::object& plugins);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_ENERGIES_H_
