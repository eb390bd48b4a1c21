#include "ceres_ed/python/errors.h"

#include <cerrno>

#include <sys/stat.h>
#include <unistd.h>

namespace ceres_ed::python {

namespace py = pybind11;

void CheckReadable(const std::string& path) {
  struct stat about = {};
  errno = 0;
  if (stat(path.c_str(), &about) == 0 && S_ISDIR(about.st_mode)) errno = EISDIR;
  if (errno == 0 && access(path.c_str(), R_OK) == 0) return;
  PyErr_SetFromErrnoWithFilename(PyExc_OSError, path.c_str());
  throw py::error_already_set();
}

void ThrowUnlessWritten(const Status& status) {
  if (status.ok()) return;
  PyErr_SetString(PyExc_OSError, status.message().c_str());
  throw py::error_already_set();
}

std::string ToPath(const py::object& path) {
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(path.ptr(), &bytes) == 0) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(bytes);
}

}  // namespace ceres_ed::python
