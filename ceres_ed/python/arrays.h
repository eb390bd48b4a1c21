// Converts arrays of numpy to vectors of the library, and makes arrays that share the memory of
// vectors.
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

// Returns whether the object is missing or None.
inline bool IsNone(const py::handle& object) { return !object || object.is_none(); }

// Returns `object`, which may be anything from which numpy makes an array, as C-contiguous doubles:
// the array itself if it is one already, otherwise a copy. Raises a ValueError that names `what` if
// it does not contain real numbers.
py::array_t<double, py::array::c_style> Doubles(const py::handle& object, const std::string& what);

// Returns points from (N, 3) numbers. Raises a ValueError that names `what` for another shape or
// type, and one that also names the row for a coordinate that is not finite (see kMaxCoordinate).
std::vector<Eigen::Vector3d> ToPoints(const py::handle& object, const std::string& what);

// Returns normals from (num_points, 3) numbers, scaled to unit length. A normal that is zero or not
// finite becomes zero.
std::vector<Eigen::Vector3d> ToNormals(const py::handle& object,
                                       std::size_t num_points,
                                       const std::string& what);

// Returns triangles from (M, 3) integers in [0, num_points). As when a file is read, triangles that
// use a point twice are left out, with a UserWarning.
std::vector<std::array<int, 3>> ToTriangles(const py::handle& object,
                                            std::size_t num_points,
                                            const std::string& what);

// Returns integers >= 0 from (N,) integers. The library checks that they are not too large.
std::vector<int> ToIndices(const py::handle& object, const std::string& what);

// Convert a similarity to a 4 x 4 matrix, and back. ToSimilarity() raises a ValueError unless the
// matrix is [s R, t; 0 0 0 1] with a rotation R and s > 0 (s = 1 unless `with_scale`).
py::array ToMatrix(const Similarity& similarity);
Similarity ToSimilarity(const py::handle& object, const std::string& what, bool with_scale);

// Returns an array that shows `rows` rows of `columns` numbers at `data`, which `owner` keeps
// alive.
template <typename T>
py::array View(T* data, std::size_t rows, std::size_t columns, const py::handle& owner) {
  return py::array_t<T>({rows, columns}, {columns * sizeof(T), sizeof(T)}, data, owner);
}

// Makes an array read-only. It is used for copies, because a value that is written to one would be
// lost; for results, which would no longer be what was computed; and for the memory of the library,
// which relies on indices that exist and numbers that are finite.
inline py::array ReadOnly(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}

// Return (N, 3) arrays that show the points, triangles or colours of `owner` and cannot be written.
inline py::array View(std::vector<Eigen::Vector3d>& points, const py::handle& owner) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "points have gaps");
  return ReadOnly(View(reinterpret_cast<double*>(points.data()), points.size(), 3, owner));
}
inline py::array View(std::vector<std::array<int, 3>>& triangles, const py::handle& owner) {
  return ReadOnly(View(reinterpret_cast<int*>(triangles.data()), triangles.size(), 3, owner));
}
inline py::array ColorView(std::vector<std::array<std::uint8_t, 3>>& colors,
                           const py::handle& owner) {
  return ReadOnly(View(reinterpret_cast<std::uint8_t*>(colors.data()), colors.size(), 3, owner));
}

// Does the same, or returns None if there are no rows.
template <typename Row>
py::object ViewOrNone(std::vector<Row>& rows, const py::handle& owner) {
  if (rows.empty()) return py::none();
  return View(rows, owner);
}

// Returns `value` on the heap, and an object that keeps it alive for the arrays that show it.
template <typename T>
std::pair<T*, py::capsule> Keep(T value) {
  T* kept = new T(std::move(value));
  return {kept, py::capsule(kept, [](void* pointer) { delete static_cast<T*>(pointer); })};
}

// Returns an (N, 3) array that owns `points` and may be written.
inline py::array OwnedView(std::vector<Eigen::Vector3d> points) {
  const auto [kept, owner] = Keep(std::move(points));
  return View(reinterpret_cast<double*>(kept->data()), kept->size(), 3, owner);
}

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_ARRAYS_H_
