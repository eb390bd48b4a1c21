// Arrays of numpy to vectors of the library, and vectors to arrays that share their memory.
#ifndef CERES_ED_PYTHON_ARRAYS_H_
#define CERES_ED_PYTHON_ARRAYS_H_

#include <ceres_ed/geometry/similarity.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace ceres_ed::python {

namespace py = pybind11;

// What is not there: None.
inline bool IsNone(const py::handle& object) { return !object || object.is_none(); }

// `object`, whatever numpy makes an array of, as C-contiguous doubles: itself where it is that
// already, else a copy. ValueError, naming `what`, unless it holds numbers.
py::array_t<double, py::array::c_style> Doubles(const py::handle& object, const std::string& what);

// Points from (N, 3) numbers. ValueError, naming `what` and the row, on another shape or on a
// number that is not finite.
std::vector<Eigen::Vector3d> ToPoints(const py::handle& object, const std::string& what);

// Normals from (num_points, 3) numbers: brought to unit length, zero where they are not finite.
std::vector<Eigen::Vector3d> ToNormals(const py::handle& object,
                                       std::size_t num_points,
                                       const std::string& what);

// Triangles from (M, 3) integers in [0, num_points). Those that name a point twice are left out
// with a UserWarning, as they are of files.
std::vector<std::array<int, 3>> ToTriangles(const py::handle& object,
                                            std::size_t num_points,
                                            const std::string& what);

// Integers from (N,); ranges are the library's question.
std::vector<int> ToIndices(const py::handle& object, const std::string& what);

// A similarity as a 4 x 4 matrix, and back. ValueError unless it is [s R, t; 0 0 0 1] with a
// rotation R and s > 0 (s = 1 unless `with_scale`).
py::array ToMatrix(const Similarity& similarity);
Similarity ToSimilarity(const py::handle& object, const std::string& what, bool with_scale);

// An array on `rows` rows of `columns` numbers at `data`, which `owner` keeps alive.
template <typename T>
py::array View(T* data, std::size_t rows, std::size_t columns, const py::handle& owner) {
  return py::array_t<T>({rows, columns}, {columns * sizeof(T), sizeof(T)}, data, owner);
}

// (N, 3) on points, and on triangles, of `owner`.
inline py::array View(std::vector<Eigen::Vector3d>& points, const py::handle& owner) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "points have gaps");
  return View(reinterpret_cast<double*>(points.data()), points.size(), 3, owner);
}
inline py::array View(std::vector<std::array<int, 3>>& triangles, const py::handle& owner) {
  return View(reinterpret_cast<int*>(triangles.data()), triangles.size(), 3, owner);
}

// The same, or None where there is nothing.
template <typename Row>
py::object ViewOrNone(std::vector<Row>& rows, const py::handle& owner) {
  if (rows.empty()) return py::none();
  return View(rows, owner);
}

// An object that keeps `value` alive, for arrays on it.
template <typename T>
std::pair<T*, py::capsule> Keep(T value) {
  T* kept = new T(std::move(value));
  return {kept, py::capsule(kept, [](void* pointer) { delete static_cast<T*>(pointer); })};
}

// (N, 3) on points that were handed over.
inline py::array OwnedView(std::vector<Eigen::Vector3d> points) {
  const auto [kept, owner] = Keep(std::move(points));
  return View(*kept, owner);
}

// Marks an array as one to look at: what is written to it would go nowhere.
inline py::array ReadOnly(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_ARRAYS_H_
