// Binds energies that are functions of Python.
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/point_functions.h>

#include <cctype>
#include <string>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

namespace py = pybind11;

// Returns the name of a function in snake_case; "function" for one without a name.
std::string NameOfFunction(const py::object& function) {
  std::string name;
  const py::object given = py::getattr(function, "__name__", py::str("function"));
  for (const char c : std::string(py::str(given))) {
    const bool is_word = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (!is_word && (name.empty() || name.back() == '_')) continue;
    name += is_word ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  const bool is_name = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
  return is_name && name != "lambda" ? name : "function";
}

PointEnergy MakePointEnergy(const py::object& function,
                            double weight,
                            const std::string& kind,
                            const std::string& loss,
                            double loss_width,
                            const py::object& name) {
  if (PyCallable_Check(function.ptr()) == 0) {
    throw py::type_error("function is " + std::string(py::str(py::type::of(function))) +
                         ", expected one that takes (points, normals)");
  }
  if (kind != "prior" && kind != "observation") {
    throw py::value_error("kind is '" + kind + "', expected 'prior' or 'observation'");
  }
  PointEnergy energy;
  energy.function = function;
  energy.kind = kind == "prior" ? EnergyKind::kPrior : EnergyKind::kObservation;
  energy.spec.name = name.is_none() ? NameOfFunction(function) : name.cast<std::string>();
  energy.spec.weight = weight;
  energy.spec.loss = {ValueOrThrow(ParseLossType(loss)), loss_width};
  return energy;
}

const char* KindName(const PointEnergy& energy) {
  return energy.kind == EnergyKind::kPrior ? "prior" : "observation";
}

py::tuple StateOf(const PointEnergy& self) {
  return py::make_tuple(self.function,
                        self.spec.weight,
                        KindName(self),
                        NameOf(self.spec.loss.type),
                        self.spec.loss.width,
                        self.spec.name);
}

PointEnergy FromState(const py::tuple& state) {
  if (py::len(state) != 6) throw py::value_error("the pickle is damaged");
  return MakePointEnergy(state[0],
                         state[1].cast<double>(),
                         state[2].cast<std::string>(),
                         state[3].cast<std::string>(),
                         state[4].cast<double>(),
                         state[5]);
}

}  // namespace

void BindPointEnergy(py::module_& module) {
  const EnergySpec defaults;
  py::class_<PointEnergy>(
      module, "PointEnergy", R"(An energy that is a function of Python over all points at once.

  function(points, normals) -> residuals, jacobian

`points` (N, 3) are the warped points, `normals` (N, 3) the unit normals of the warped surface there
(zero where unknown); `residuals` are (N,) or (N, R), and `jacobian` (N, 3) or (N, R, 3) is their
derivative with respect to the points. Row k of both depends on point k only; the library carries
them on to the nodes, and takes the normals as constant in a step. A function with a third parameter
also gets the indices (N,) of the points in the source: a step may look at some points only.

Points are in the frame of a fit: the axes of the target, the diagonal of the source as the unit,
and the centre of the placed source as the origin. In a tracker they are in the frame of the camera,
with the distance of neighbouring nodes as the unit. The function is called once a step, by any
thread, with the interpreter's lock.)")
      .def(py::init(&MakePointEnergy),
           py::arg("function"),
           py::arg("weight") = defaults.weight,
           py::kw_only(),
           py::arg("kind") = "prior",
           py::arg("loss") = NameOf(defaults.loss.type),
           py::arg("loss_width") = defaults.loss.width,
           py::arg("name") = py::none(),
           R"(Takes the function and how it takes part.

Args:
  function: what returns residuals and derivatives. An exception in it ends the fit and is raised.
  weight: >= 0, without unit.
  kind: 'prior', or 'observation', which makes the nodes it depends on point relevant.
  loss, loss_width: the robust loss, as in Energy.
  name: its name in messages and in FitResult.terms, in snake_case. None means that of the function.)")
      .def_property_readonly("function", [](const PointEnergy& self) { return self.function; })
      .def_property_readonly("name", [](const PointEnergy& self) { return self.spec.name; })
      .def_property_readonly("weight", [](const PointEnergy& self) { return self.spec.weight; })
      .def_property_readonly("kind", &KindName)
      .def_property_readonly("loss",
                             [](const PointEnergy& self) { return NameOf(self.spec.loss.type); })
      .def_property_readonly("loss_width",
                             [](const PointEnergy& self) { return self.spec.loss.width; })
      .def("__repr__",
           [](const PointEnergy& self) {
             return "<ceres_ed.PointEnergy " + self.spec.name + " of " +
                    std::string(py::repr(self.function)) + ">";
           })
      .def(py::pickle(&StateOf, &FromState));
}

}  // namespace ceres_ed::python
