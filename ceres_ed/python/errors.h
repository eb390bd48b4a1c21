// Raises the errors of the library as exceptions of Python.
#ifndef CERES_ED_PYTHON_ERRORS_H_
#define CERES_ED_PYTHON_ERRORS_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <utility>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// Raise a ValueError with the library's sentence if there is an error.
inline void ThrowUnlessOk(const Status& status) {
  if (!status.ok()) throw pybind11::value_error(status.message());
}
template <typename T>
T ValueOrThrow(StatusOr<T> value) {
  ThrowUnlessOk(value.status());
  return *std::move(value);
}

// Raises an OSError of the right kind (FileNotFoundError, PermissionError ...) unless `path` can be
// read.
void CheckReadable(const std::string& path);

// Raises an OSError with the library's sentence if a file could not be written.
void ThrowUnlessWritten(const Status& status);

// Returns a path from a str or an os.PathLike.
std::string ToPath(const pybind11::object& path);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_ERRORS_H_
