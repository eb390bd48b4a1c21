#include "ceres_ed/python/arrays.h"

#include <ceres_ed/io/cloud_io.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>

namespace ceres_ed::python {
namespace {

std::string ShapeOf(const py::array& array) {
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    shape += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  }
  return "(" + shape + (array.ndim() == 1 ? ",)" : ")");
}

// Returns the array that numpy makes of an object. Raises a ValueError if its dtype is not among
// `kinds`.
py::array ArrayOf(const py::handle& object,
                  const std::string& what,
                  const char* kinds,
                  const char* expected) {
  py::array array = py::array::ensure(object);
  // numpy makes an array of a single object from anything that it does not understand.
  if (!array || (array.ndim() == 0 && array.dtype().kind() == 'O')) {
    throw py::value_error(what + " is " + std::string(py::str(py::type::of(object))) +
                          ", expected an array of " + expected);
  }
  // An empty list becomes an array of floats, so its dtype is not checked.
  if (array.size() > 0 && std::strchr(kinds, array.dtype().kind()) == nullptr) {
    throw py::value_error(what + " is an array of " + std::string(py::str(array.dtype())) +
                          ", expected " + expected);
  }
  return array;
}

template <typename T>
py::array_t<T, py::array::c_style> Contiguous(const py::array& array, const std::string& what) {
  auto contiguous = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!contiguous) throw py::value_error(what + " can't be converted");
  return contiguous;
}

void CheckRows(const py::array& array, const std::string& what, const char* rows) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  throw py::value_error(what + " has shape " + ShapeOf(array) + ", expected (" + rows + ", 3)");
}

py::array_t<std::int64_t, py::array::c_style> Integers(const py::handle& object,
                                                       const std::string& what) {
  return Contiguous<std::int64_t>(ArrayOf(object, what, "iu", "integers"), what);
}

}  // namespace

py::array_t<double, py::array::c_style> Doubles(const py::handle& object, const std::string& what) {
  return Contiguous<double>(ArrayOf(object, what, "fiub", "real numbers"), what);
}

std::vector<Eigen::Vector3d> ToPoints(const py::handle& object, const std::string& what) {
  const auto array = Doubles(object, what);
  CheckRows(array, what, "N");
  std::vector<Eigen::Vector3d> points(static_cast<std::size_t>(array.shape(0)));
  if (points.empty()) return points;
  std::copy_n(array.data(), 3 * points.size(), points.front().data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // The comparison is false for NaN, too.
    if ((points[i].array().abs() <= kMaxCoordinate).all()) continue;
    std::ostringstream message;
    message << what << " has [" << points[i].transpose() << "] in row " << i
            << ", expected finite numbers";
    throw py::value_error(message.str());
  }
  return points;
}

std::vector<Eigen::Vector3d> ToNormals(const py::handle& object,
                                       std::size_t num_points,
                                       const std::string& what) {
  const auto array = Doubles(object, what);
  CheckRows(array, what, "N");
  std::vector<Eigen::Vector3d> normals(static_cast<std::size_t>(array.shape(0)));
  if (normals.size() != num_points) {
    throw py::value_error(what + " has " + std::to_string(normals.size()) +
                          " rows, expected one for each of " + std::to_string(num_points) +
                          " points");
  }
  if (normals.empty()) return normals;
  std::copy_n(array.data(), 3 * normals.size(), normals.front().data());
  for (Eigen::Vector3d& normal : normals) {
    const double length = normal.norm();
    const bool has_direction = std::isfinite(length) && length > 0.0;
    normal = has_direction ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
  }
  return normals;
}

std::vector<std::array<int, 3>> ToTriangles(const py::handle& object,
                                            std::size_t num_points,
                                            const std::string& what) {
  const auto array = Integers(object, what);
  std::vector<std::array<int, 3>> triangles;
  if (array.size() == 0) return triangles;
  CheckRows(array, what, "M");
  const std::int64_t* corner = array.data();
  triangles.reserve(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t row = 0; row < array.shape(0); ++row, corner += 3) {
    for (int i = 0; i < 3; ++i) {
      if (corner[i] >= 0 && corner[i] < static_cast<std::int64_t>(num_points)) continue;
      throw py::value_error(what + " names point " + std::to_string(corner[i]) + " in row " +
                            std::to_string(row) + ", there are " + std::to_string(num_points));
    }
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    triangles.push_back(
        {static_cast<int>(corner[0]), static_cast<int>(corner[1]), static_cast<int>(corner[2])});
  }
  const std::size_t dropped = static_cast<std::size_t>(array.shape(0)) - triangles.size();
  if (dropped > 0) {
    const std::string text =
        what + ": left out " + std::to_string(dropped) + " with a repeated corner";
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  }
  return triangles;
}

std::vector<int> ToIndices(const py::handle& object, const std::string& what) {
  const auto array = Integers(object, what);
  if (array.ndim() != 1) {
    throw py::value_error(what + " has shape " + ShapeOf(array) + ", expected (N,)");
  }
  std::vector<int> indices;
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    const std::int64_t index = array.data()[i];
    if (index < 0 || index > std::numeric_limits<int>::max()) {
      throw py::value_error(what + " has " + std::to_string(index) + ", expected an index >= 0");
    }
    indices.push_back(static_cast<int>(index));
  }
  return indices;
}

py::array ToMatrix(const Similarity& similarity) {
  py::array_t<double> matrix({4, 4});
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> map(matrix.mutable_data());
  map.setIdentity();
  map.topLeftCorner<3, 3>() = similarity.scale * similarity.rotation.toRotationMatrix();
  map.topRightCorner<3, 1>() = similarity.translation;
  return std::move(matrix);
}

Similarity ToSimilarity(const py::handle& object, const std::string& what, bool with_scale) {
  const auto array = Doubles(object, what);
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) {
    throw py::value_error(what + " has shape " + ShapeOf(array) + ", expected (4, 4)");
  }
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.data());
  const Eigen::Matrix3d scaled = matrix.topLeftCorner<3, 3>();
  const double determinant = scaled.determinant();
  Similarity similarity;
  similarity.scale = with_scale ? std::cbrt(determinant) : 1.0;
  const Eigen::Matrix3d R = scaled / similarity.scale;
  // Poses in files and from sensors have few digits.
  constexpr double kTolerance = 1e-3;
  const bool is_rigid = matrix.allFinite() && determinant > 0.0 &&
                        (R * R.transpose()).isIdentity(kTolerance) &&
                        matrix.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
  if (!is_rigid) {
    throw py::value_error(
        what +
        (with_scale ? " is not [s R, t; 0 0 0 1] with s > 0 and" : " is not [R, t; 0 0 0 1] with") +
        " a rotation R");
  }
  similarity.rotation = Eigen::Quaterniond(R).normalized();
  similarity.translation = matrix.topRightCorner<3, 1>();
  return similarity;
}

}  // namespace ceres_ed::python
