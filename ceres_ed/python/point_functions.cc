#include "ceres_ed/python/point_functions.h"

#include <ceres_ed/energy/batch_energy.h>
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/errors.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace ceres_ed::python {
namespace {

// Returns whether the function also takes the indices of the points, as a third argument.
bool TakesIndices(const py::object& function) {
  try {
    const py::module_ inspect = py::module_::import("inspect");
    const py::object signature = inspect.attr("signature")(function);
    int positional = 0;
    for (const py::handle parameter : signature.attr("parameters").attr("values")()) {
      const py::object kind = parameter.attr("kind");
      if (kind.equal(inspect.attr("Parameter").attr("VAR_POSITIONAL"))) return true;
      const bool named = kind.equal(inspect.attr("Parameter").attr("KEYWORD_ONLY")) ||
                         kind.equal(inspect.attr("Parameter").attr("VAR_KEYWORD"));
      if (!named) ++positional;
    }
    return positional >= 3;
  } catch (py::error_already_set&) {
    // Some functions of C have no signature.
    return false;
  }
}

std::string ShapeText(const py::array& array) { return py::str(array.attr("shape")); }

// The values that a call has returned, checked.
struct Returned {
  int num_residuals = 0;
  py::array_t<double, py::array::c_style> residuals;
  py::array_t<double, py::array::c_style> jacobian;
};

class PythonFunction final : public PointBatchFunction {
 public:
  PythonFunction(const PointEnergy& energy, std::shared_ptr<FunctionErrors> errors)
      : function_(energy.function),
        name_("energy '" + energy.spec.name + "'"),
        takes_indices_(TakesIndices(energy.function)),
        errors_(std::move(errors)) {}

  int NumResiduals(const PointBatch& at_rest) const override {
    const py::gil_scoped_acquire lock;
    Returned returned;
    if (!Call(at_rest, 0, &returned)) throw std::runtime_error("the function failed");
    return returned.num_residuals;
  }

  bool Evaluate(const PointBatch& batch,
                int num_residuals,
                double* residuals,
                double* jacobians) const override {
    const py::gil_scoped_acquire lock;
    Returned returned;
    if (!Call(batch, num_residuals, &returned)) return false;
    std::copy_n(returned.residuals.data(), returned.residuals.size(), residuals);
    std::copy_n(returned.jacobian.data(), returned.jacobian.size(), jacobians);
    return true;
  }

 private:
  // Calls the function. Returns false if it, or another one, has raised an exception. The lock must
  // be held.
  bool Call(const PointBatch& batch, int num_residuals, Returned* returned) const {
    if (errors_->failed()) return false;
    try {
      // Copies: the function may keep them.
      const py::array_t<double> points({batch.count, 3}, batch.points);
      const py::array_t<double> normals({batch.count, 3}, batch.normals);
      const py::array_t<int> indices(batch.count, batch.indices);
      const py::object result =
          takes_indices_ ? function_(points, normals, indices) : function_(points, normals);
      *returned = Check(result, batch, num_residuals);
      return true;
    } catch (...) {
      errors_->Store();
      return false;
    }
  }

  Returned Check(const py::object& result, const PointBatch& batch, int num_residuals) const {
    const bool is_pair = (py::isinstance<py::tuple>(result) || py::isinstance<py::list>(result)) &&
                         py::len(result) == 2;
    if (!is_pair) {
      throw py::type_error(name_ + ": the function returned " +
                           std::string(py::str(py::type::of(result))) +
                           ", expected a pair (residuals, jacobian)");
    }
    const py::tuple pair(result);
    Returned returned;
    returned.residuals = Doubles(pair[0], name_ + ": residuals");
    returned.jacobian = Doubles(pair[1], name_ + ": jacobian");
    const std::string count = std::to_string(batch.count);
    const py::array& r = returned.residuals;
    const bool is_column = r.ndim() == 1;
    if ((!is_column && r.ndim() != 2) || r.shape(0) != batch.count || r.size() == 0) {
      throw py::value_error(name_ + ": residuals have shape " + ShapeText(r) + ", expected (" +
                            count + ",) or (" + count + ", R)");
    }
    returned.num_residuals = is_column ? 1 : static_cast<int>(r.shape(1));
    if (num_residuals > 0 && returned.num_residuals != num_residuals) {
      throw py::value_error(name_ + ": residuals have shape " + ShapeText(r) + ", expected " +
                            std::to_string(num_residuals) + " a point as in the first call");
    }
    CheckJacobian(returned, batch);
    CheckFinite(returned.residuals, "residuals", batch);
    CheckFinite(returned.jacobian, "jacobian", batch);
    return returned;
  }

  void CheckJacobian(const Returned& returned, const PointBatch& batch) const {
    const py::array& J = returned.jacobian;
    const int R = returned.num_residuals;
    const bool flat = R == 1 && J.ndim() == 2 && J.shape(0) == batch.count && J.shape(1) == 3;
    const bool full =
        J.ndim() == 3 && J.shape(0) == batch.count && J.shape(1) == R && J.shape(2) == 3;
    if (flat || full) return;
    const std::string count = std::to_string(batch.count);
    throw py::value_error(name_ + ": jacobian has shape " + ShapeText(J) + ", expected (" + count +
                          ", " + std::to_string(R) + ", 3)" +
                          (R == 1 ? " or (" + count + ", 3)" : ""));
  }

  void CheckFinite(const py::array_t<double, py::array::c_style>& values,
                   const char* what,
                   const PointBatch& batch) const {
    const double* const end = values.data() + values.size();
    const double* const bad =
        std::find_if(values.data(), end, [](double value) { return !std::isfinite(value); });
    if (bad == end) return;
    const auto row = static_cast<int>((bad - values.data()) / (values.size() / batch.count));
    const double* const p = batch.points + 3 * row;
    throw py::value_error(name_ + ": " + what + " has " + std::string(py::str(py::float_(*bad))) +
                          " in row " + std::to_string(row) + " (point " +
                          std::to_string(batch.indices[row]) + ", at " + std::to_string(p[0]) +
                          " " + std::to_string(p[1]) + " " + std::to_string(p[2]) +
                          "), expected finite numbers");
  }

  py::object function_;
  std::string name_;
  bool takes_indices_;
  std::shared_ptr<FunctionErrors> errors_;
};

}  // namespace

void RegisterFunction(const PointEnergy& energy,
                      const std::shared_ptr<FunctionErrors>& errors,
                      EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = energy.spec.name;
  info.summary = "a function of Python";
  info.equation = "r(points, normals)";
  info.unit = "-";
  info.kind = energy.kind;
  const auto function = std::make_shared<const PythonFunction>(energy, errors);
  ThrowUnlessOk(registry->Register(info, [function, kind = energy.kind](const ParameterValues&) {
    return ForAllPoints(kind, function);
  }));
}

}  // namespace ceres_ed::python
