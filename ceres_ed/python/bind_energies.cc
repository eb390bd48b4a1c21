// Binds energies with their parameters, and the shared objects that add more of them.
#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/plugin/plugin_loader.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/energies.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/pickles.h>

#include <string>
#include <utility>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

namespace py = pybind11;

EnergySpec MakeEnergy(const std::string& name,
                      double weight,
                      const std::string& loss,
                      double loss_width,
                      const py::kwargs& parameters) {
  EnergySpec spec;
  spec.name = name;
  spec.weight = weight;
  spec.loss = {ValueOrThrow(ParseLossType(loss)), loss_width};
  for (const auto& [key, value] : parameters) {
    spec.parameters[py::str(key)] = py::float_(py::reinterpret_borrow<py::object>(value));
  }
  return spec;
}

std::string Describe(const EnergySpec& spec) {
  std::string text = "Energy('" + spec.name +
                     "', weight=" + std::string(py::repr(py::float_(spec.weight))) + ", loss='" +
                     NameOf(spec.loss.type) +
                     "', loss_width=" + std::string(py::repr(py::float_(spec.loss.width)));
  for (const auto& [name, value] : spec.parameters) {
    text += ", " + name + "=" + std::string(py::repr(py::float_(value)));
  }
  return text + ")";
}

void Append(const py::handle& energy, EnergyArguments* arguments) {
  if (py::isinstance<EnergySpec>(energy)) {
    arguments->specs.push_back(energy.cast<EnergySpec>());
    return;
  }
  if (py::isinstance<PointEnergy>(energy)) {
    const auto& function = energy.cast<const PointEnergy&>();
    RegisterFunction(function, arguments->errors, &arguments->registry);
    arguments->specs.push_back(function.spec);
    return;
  }
  if (!py::isinstance<py::str>(energy)) {
    throw py::type_error("an energy is " + std::string(py::str(py::type::of(energy))) +
                         ", expected an Energy, a PointEnergy or a str");
  }
  for (EnergySpec& spec : ValueOrThrow(ParseEnergySpecs(energy.cast<std::string>()))) {
    arguments->specs.push_back(std::move(spec));
  }
}

const char* TypeName(ParameterType type) {
  switch (type) {
    case ParameterType::kReal:
      return "real";
    case ParameterType::kInteger:
      return "integer";
    case ParameterType::kFlag:
      return "flag";
  }
  return "real";
}

std::vector<EnergyInfo> ListEnergies(const py::object& plugin) {
  const EnergyRegistry registry = MakeRegistry(plugin);
  std::vector<EnergyInfo> infos;
  for (const EnergyInfo* info : registry.List()) infos.push_back(*info);
  return infos;
}

void BindInfo(py::module_& module) {
  py::class_<EnergyParameter>(module, "EnergyParameter", "A parameter of an energy.")
      .def_readonly("name", &EnergyParameter::name)
      .def_property_readonly(
          "type",
          [](const EnergyParameter& self) { return TypeName(self.type); },
          "'real', 'integer' or 'flag' (0 or 1).")
      .def_readonly("unit", &EnergyParameter::unit, "The unit; '-' if there is none.")
      .def_readonly("minimum", &EnergyParameter::minimum)
      .def_readonly("maximum", &EnergyParameter::maximum)
      .def_readonly("default", &EnergyParameter::default_value)
      .def_readonly("doc", &EnergyParameter::doc)
      .def("__repr__", [](const EnergyParameter& self) {
        return "<ceres_ed.EnergyParameter " + self.name + ": " + self.doc + ">";
      });
  py::class_<EnergyInfo>(module, "EnergyInfo", "The description of an energy.")
      .def_readonly("name", &EnergyInfo::name)
      .def_readonly("summary", &EnergyInfo::summary, "What the energy aims at, in one line.")
      .def_readonly("equation", &EnergyInfo::equation, "The residual as an equation.")
      .def_readonly("unit", &EnergyInfo::unit, "The unit of the residual.")
      .def_property_readonly(
          "is_observation",
          [](const EnergyInfo& self) { return self.kind == EnergyKind::kObservation; },
          "Whether the nodes on which it depends become point relevant. A prior does not do this.")
      .def_readonly("parameters", &EnergyInfo::parameters)
      .def("__repr__", [](const EnergyInfo& self) {
        return "<ceres_ed.EnergyInfo " + self.name + ": " + self.summary + ">";
      });
}

}  // namespace

EnergyArguments ToEnergies(const py::object& energies, const py::object& plugins) {
  EnergyArguments arguments;
  arguments.registry = MakeRegistry(plugins);
  if (energies.is_none()) return arguments;
  const bool is_one = py::isinstance<py::str>(energies) || py::isinstance<EnergySpec>(energies) ||
                      py::isinstance<PointEnergy>(energies);
  if (is_one) {
    Append(energies, &arguments);
  } else {
    for (const py::handle energy : energies) Append(energy, &arguments);
  }
  return arguments;
}

EnergyRegistry MakeRegistry(const py::object& plugins) {
  EnergyRegistry registry = BuiltinEnergies();
  if (plugins.is_none()) return registry;
  const bool is_sequence = py::isinstance<py::list>(plugins) || py::isinstance<py::tuple>(plugins);
  const py::list paths = is_sequence ? py::list(plugins) : py::list(py::make_tuple(plugins));
  for (const py::handle path_object : paths) {
    const std::string path = ToPath(py::reinterpret_borrow<py::object>(path_object));
    CheckReadable(path);
    ThrowUnlessOk(LoadPlugin(path, &registry));
  }
  return registry;
}

void BindEnergies(py::module_& module) {
  const EnergySpec defaults;
  py::class_<EnergySpec> energy(module, "Energy", "An energy that is added to an objective.");
  energy
      .def(py::init(&MakeEnergy),
           py::arg("name"),
           py::arg("weight") = defaults.weight,
           py::arg("loss") = NameOf(defaults.loss.type),
           py::arg("loss_width") = defaults.loss.width,
           R"(Takes the name of an energy, and its parameters as keywords.

list_energies() describes the energies. Parameters that are not given have defaults.

Args:
  name: the name of the energy.
  weight: >= 0, without unit.
  loss: the robust loss: squared, huber, cauchy, tukey, welsch or geman_mcclure.
  loss_width: the size of the residual, in its unit, above which the loss reduces its influence,
    > 0.)")
      .def_readonly("name", &EnergySpec::name)
      .def_readonly("weight", &EnergySpec::weight)
      .def_property_readonly("loss", [](const EnergySpec& self) { return NameOf(self.loss.type); })
      .def_property_readonly("loss_width", [](const EnergySpec& self) { return self.loss.width; })
      .def_readonly(
          "parameters", &EnergySpec::parameters, "The parameters that were given, by name.")
      .def("__repr__", &Describe);
  AddPickle(&energy);
  BindInfo(module);
  module.def(
      "list_energies",
      &ListEnergies,
      py::arg("plugin") = py::none(),
      R"(Returns an EnergyInfo for each energy of the library and of `plugin`, sorted by name.

`plugin` is the path of a shared object (ceres_ed/plugin/plugin_abi.h), or a list of paths.
Raises an OSError if one can't be read, and a ValueError if it is not a plugin or was built for
another version.)");
}

}  // namespace ceres_ed::python
