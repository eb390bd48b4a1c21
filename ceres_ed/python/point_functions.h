// Energies that are functions of Python: one call a step, with all points.
#ifndef CERES_ED_PYTHON_POINT_FUNCTIONS_H_
#define CERES_ED_PYTHON_POINT_FUNCTIONS_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>

#include <atomic>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// The class PointEnergy.
struct PointEnergy {
  pybind11::object function;
  EnergyKind kind = EnergyKind::kPrior;
  // Its name, weight and loss; it has no parameters.
  EnergySpec spec;
};

// The first exception of the functions of a fit or a tracker. It is stored and read with the
// interpreter's lock.
class FunctionErrors {
 public:
  bool failed() const { return failed_; }
  // Stores the exception that is being handled, unless there is one already.
  void Store() {
    if (failed_) return;
    error_ = std::current_exception();
    failed_ = true;
  }
  // Throws the exception, if there is one, with its traceback.
  void Rethrow() {
    if (!failed_) return;
    failed_ = false;
    std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  std::atomic<bool> failed_ = false;
  std::exception_ptr error_;
};

// Adds `energy` to `registry`, so that its spec may name it. Raises a ValueError if its name is
// taken.
void RegisterFunction(const PointEnergy& energy,
                      const std::shared_ptr<FunctionErrors>& errors,
                      EnergyRegistry* registry);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_POINT_FUNCTIONS_H_
