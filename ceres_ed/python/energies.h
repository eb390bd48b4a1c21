// Converts energies from Python.
#ifndef CERES_ED_PYTHON_ENERGIES_H_
#define CERES_ED_PYTHON_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/python/point_functions.h>

#include <memory>
#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// The energies that a fit or a tracker adds.
struct EnergyArguments {
  std::vector<EnergySpec> specs;
  // What they may name: the energies of the library, of plugins and of Python.
  EnergyRegistry registry;
  // The exceptions of the functions of Python.
  std::shared_ptr<FunctionErrors> errors = std::make_shared<FunctionErrors>();
};

// Returns energies from None, a text as in --energy, an Energy, a PointEnergy, or a sequence of
// these. `plugins` are those of MakeRegistry(). Raises a ValueError for a text that cannot be
// parsed, and a TypeError for anything else.
EnergyArguments ToEnergies(const pybind11::object& energies, const pybind11::object& plugins);

// Returns the energies of the library and of `plugins`: None, a path or a sequence of paths. Raises
// an OSError if a file cannot be read, and a ValueError if it is not a plugin of this library.
EnergyRegistry MakeRegistry(const pybind11::object& plugins);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_ENERGIES_H_
