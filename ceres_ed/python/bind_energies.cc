// Energies by name and parameters, and the shared objects that bring more of them.
#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/plugin/plugin_loader.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/energies.h>
#include <ceres_ed/python/errors.h>

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

void Append(const py::handle& energy, std::vector<EnergySpec>* specs) {
  if (py::isinstance<EnergySpec>(energy)) {
    specs->push_back(energy.cast<EnergySpec>());
    return;
  }
  if (!py::isinstance<py::str>(energy)) {
    throw py::type_error("an energy is " + std::string(py::str(py::type::of(energy))) +
                         ", expected an Energy or a str");
  }
  for (EnergySpec& spec : ValueOrThrow(ParseEnergySpecs(energy.cast<std::string>()))) {
    specs->push_back(std::move(spec));
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
      .def_readonly("unit", &EnergyParameter::unit, "'-' where it has none.")
      .def_readonly("minimum", &EnergyParameter::minimum)
      .def_readonly("maximum", &EnergyParameter::maximum)
      .def_readonly("default", &EnergyParameter::default_value)
      .def_readonly("doc", &EnergyParameter::doc)
      .def("__repr__", [](const EnergyParameter& self) {
        return "<ceres_ed.EnergyParameter " + self.name + ": " + self.doc + ">";
      });
  py::class_<EnergyInfo>(module, "EnergyInfo", "What is known of an energy.")
      .def_readonly("name", &EnergyInfo::name)
      .def_readonly("summary", &EnergyInfo::summary, "What it wants, in one line.")
      .def_readonly("equation", &EnergyInfo::equation, "The residual.")
      .def_readonly("unit", &EnergyInfo::unit, "Of the residual.")
      .def_property_readonly(
          "is_observation",
          [](const EnergyInfo& self) { return self.kind == EnergyKind::kObservation; },
          "Whether it makes the nodes that it reaches point relevant; a prior does not.")
      .def_readonly("parameters", &EnergyInfo::parameters)
      .def("__repr__", [](const EnergyInfo& self) {
        return "<ceres_ed.EnergyInfo " + self.name + ": " + self.summary + ">";
      });
}

}  // namespace

std::vector<EnergySpec> ToEnergies(const py::object& energies) {
  std::vector<EnergySpec> specs;
  if (energies.is_none()) return specs;
  if (py::isinstance<py::str>(energies) || py::isinstance<EnergySpec>(energies)) {
    Append(energies, &specs);
  } else {
    for (const py::handle energy : energies) Append(energy, &specs);
  }
  return specs;
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
  py::class_<EnergySpec>(module, "Energy", "One more energy to add to an objective.")
      .def(py::init(&MakeEnergy),
           py::arg("name"),
           py::arg("weight") = defaults.weight,
           py::arg("loss") = NameOf(defaults.loss.type),
           py::arg("loss_width") = defaults.loss.width,
           R"(An energy of list_energies() with its parameters as keywords; the rest have defaults.

Args:
  weight: >= 0, no unit.
  loss: robust loss: squared huber cauchy tukey welsch geman_mcclure.
  loss_width: residual, in its unit, at which the loss begins to give way, > 0.)")
      .def_readonly("name", &EnergySpec::name)
      .def_readonly("weight", &EnergySpec::weight)
      .def_property_readonly("loss", [](const EnergySpec& self) { return NameOf(self.loss.type); })
      .def_property_readonly("loss_width", [](const EnergySpec& self) { return self.loss.width; })
      .def_readonly("parameters", &EnergySpec::parameters, "Those that were given, by name.")
      .def("__repr__", &Describe);
  BindInfo(module);
  module.def("list_energies",
             &ListEnergies,
             py::arg("plugin") = py::none(),
             R"(Returns an EnergyInfo for each energy of the library, and of `plugin`, by name.

`plugin` is the path of a shared object (ceres_ed/plugin/plugin_abi.h), or a list of them. OSError
where one can't be read, ValueError where it is no plugin or was built against another version.)");
}

}  // namespace ceres_ed::python
