// Calls Python functions while the library works without the interpreter's lock.
#ifndef CERES_ED_PYTHON_CALLBACKS_H_
#define CERES_ED_PYTHON_CALLBACKS_H_

#include <ceres_ed/util/timer.h>

#include <exception>
#include <functional>
#include <utility>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// Takes the lock for each call. An exception (for example KeyboardInterrupt) requests that the work
// stops. It is stored until the work has stopped.
class Callbacks {
 public:
  // `should_stop` is None, or a function that returns whether the work should stop.
  explicit Callbacks(pybind11::object should_stop) : should_stop_(std::move(should_stop)) {}

  // Returns whether the work should stop. Calls Python at most fifty times per second, because
  // another thread may hold the lock, and waiting for it takes time.
  bool ShouldStop() {
    constexpr double kInterval = 0.02;
    if (stop_ || timer_.Seconds() < kInterval) return stop_;
    Call([this] {
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      if (!should_stop_.is_none()) stop_ = pybind11::bool_(should_stop_());
    });
    timer_ = Timer();
    return stop_;
  }

  // Calls `function` with the lock. After an exception it does nothing.
  void Call(const std::function<void()>& function) {
    if (error_) return;
    const pybind11::gil_scoped_acquire lock;
    try {
      function();
    } catch (...) {
      error_ = std::current_exception();
      stop_ = true;
    }
  }

  // Throws the stored exception, if there is one. The lock must be held.
  void Rethrow() {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  pybind11::object should_stop_;
  Timer timer_;
  bool stop_ = false;
  std::exception_ptr error_;
};

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_CALLBACKS_H_
