// Binds the statistics of populations of shapes.
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/statistics/group_test.h>
#include <ceres_ed/statistics/model_quality.h>
#include <ceres_ed/statistics/procrustes.h>
#include <ceres_ed/statistics/shape_model.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

namespace py = pybind11;

using Matrix = ShapesInMemory::Matrix;

// Returns N x 3 V numbers from an array (N, V, 3).
Matrix ToShapes(const py::handle& object) {
  const py::array_t<double, py::array::c_style> array = Doubles(object, "shapes");
  if (array.ndim() != 3 || array.shape(2) != 3 || array.size() == 0) {
    throw py::value_error("shapes: expected an array of (N, V, 3) numbers, N and V at least 1");
  }
  Matrix rows = Eigen::Map<const Matrix>(array.data(), array.shape(0), array.shape(1) * 3);
  if (!rows.allFinite()) {
    Eigen::Index row = 0;
    while (rows.row(row).allFinite()) ++row;
    throw py::value_error("shapes: shape " + std::to_string(row) +
                          " is not finite, expected finite numbers");
  }
  return rows;
}

// Returns an array (N, V, 3) of N x 3 V numbers.
py::array_t<double> FromShapes(const Matrix& rows) {
  py::array_t<double> array({rows.rows(), rows.cols() / 3, Eigen::Index{3}});
  std::copy(rows.data(), rows.data() + rows.size(), array.mutable_data());
  return array;
}

py::tuple AlignPython(const py::object& object, const std::string& align, const py::object& frame) {
  const auto alignment = FindByName<Alignment>(align);
  if (!alignment) {
    throw py::value_error("align is '" + align + "', expected one of " +
                          ListNames<Alignment>(", "));
  }
  Matrix rows = ToShapes(object);
  Eigen::VectorXd onto = rows.row(0);
  if (!frame.is_none()) {
    const std::vector<Eigen::Vector3d> points = ToPoints(frame, "frame");
    if (static_cast<Eigen::Index>(3 * points.size()) != rows.cols()) {
      throw py::value_error("frame: " + std::to_string(points.size()) + " points, expected " +
                            std::to_string(rows.cols() / 3));
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
      onto.segment<3>(3 * static_cast<Eigen::Index>(v)) = points[v];
    }
  }
  const ShapesInMemory table(rows);
  const AlignedShapes aligned = ValueOrThrow(AlignShapes(table, *alignment, onto));
  py::list transforms;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) = TransformShape(aligned.transforms[i], rows.row(i).transpose()).transpose();
    transforms.append(ToMatrix(aligned.transforms[i]));
  }
  return py::make_tuple(FromShapes(rows), py::module_::import("numpy").attr("array")(transforms));
}

ShapeModel FitModelPython(const py::object& shapes, int components) {
  if (components < 1) {
    throw py::value_error("components is " + std::to_string(components) + ", expected >= 1");
  }
  return ValueOrThrow(FitShapeModel(ShapesInMemory(ToShapes(shapes)), components));
}

py::dict QualityPython(const py::object& shapes, int components, int samples, std::uint64_t seed) {
  if (components < 1 || samples < 1) {
    throw py::value_error("components and samples: expected >= 1");
  }
  ModelQualityOptions options;
  options.max_components = components;
  options.samples = samples;
  options.seed = seed;
  const ModelQuality quality =
      ValueOrThrow(MeasureModelQuality(ShapesInMemory(ToShapes(shapes)), options));
  const auto array = [](const std::vector<double>& values) {
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  };
  py::dict report;
  report["generalization"] = array(quality.generalization);
  report["generalization_error"] = array(quality.generalization_error);
  report["specificity"] = array(quality.specificity);
  report["shapes"] = quality.shapes;
  return report;
}

// Returns the number of each label among the sorted labels.
std::vector<int> Numbers(const std::vector<std::string>& labels) {
  std::vector<std::string> sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::vector<int> numbers;
  numbers.reserve(labels.size());
  for (const std::string& label : labels) {
    numbers.push_back(
        static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), label) - sorted.begin()));
  }
  return numbers;
}

py::dict ComparePython(const py::object& shapes,
                       const py::iterable& groups,
                       int permutations,
                       std::uint64_t seed) {
  std::vector<std::string> labels;
  for (const py::handle& group : groups) labels.push_back(py::str(group));
  if (permutations < 1) {
    throw py::value_error("permutations is " + std::to_string(permutations) + ", expected >= 1");
  }
  const GroupTest test = ValueOrThrow(
      TestGroups(ShapesInMemory(ToShapes(shapes)), Numbers(labels), {permutations, seed}));
  const auto array = [](const std::vector<double>& values) {
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  };
  py::dict report;
  report["difference"] = array(test.difference);
  report["statistic"] = array(test.statistic);
  report["p"] = array(test.p);
  report["p_corrected"] = array(test.p_corrected);
  return report;
}

void BindShapeModel(py::module_& module) {
  using M = ShapeModel;
  py::class_<M>(module,
                "ShapeModel",
                "Mean and principal components of shapes: x = mean + sum_k b_k components[k].")
      .def_property_readonly(
          "mean",
          [](const M& self) {
            const Matrix rows = self.mean.transpose();
            return FromShapes(rows).attr("reshape")(-1, 3);
          },
          "The mean, (V, 3).")
      .def_property_readonly(
          "components",
          [](const M& self) {
            const Matrix rows = self.components.transpose();
            return FromShapes(rows);
          },
          "The orthonormal components, (K, V, 3).")
      .def_property_readonly(
          "variances",
          [](const M& self) { return self.variances; },
          "The variance of each b_k, in the squared unit of the shapes; descending.")
      .def_property_readonly(
          "explained",
          [](const M& self) { return self.ExplainedShares(); },
          "The share of the total variance that each component explains.")
      .def_property_readonly(
          "scores", [](const M& self) { return self.scores; }, "b_k of each shape, (N, K).")
      .def_property_readonly(
          "vertex_variances",
          [](const M& self) {
            return py::array_t<double>(static_cast<py::ssize_t>(self.vertex_variances.size()),
                                       self.vertex_variances.data());
          },
          "The variance of each vertex, (V,).")
      .def_readonly("total_variance", &M::total_variance)
      .def("__repr__", [](const M& self) {
        return "<ceres_ed.ShapeModel of " + std::to_string(self.scores.rows()) + " shapes, " +
               std::to_string(self.variances.size()) + " components>";
      });
}

}  // namespace

void BindShapeStatistics(py::module_& module) {
  BindShapeModel(module);
  module.def("align_shapes",
             &AlignPython,
             py::arg("shapes"),
             py::kw_only(),
             py::arg("align") = "similarity",
             py::arg("frame") = py::none(),
             R"(Aligns shapes (N, V, 3) to their mean (generalised Procrustes).

`align` is "similarity" (position, rotation and size are taken out), "rigid" (all but the size) or
"none". The mean is moved rigidly onto `frame` (V, 3); without it, onto the first shape. Returns the
aligned shapes and the transforms (N, 4, 4) that took them there.)");
  module.def(
      "fit_shape_model",
      &FitModelPython,
      py::arg("shapes"),
      py::kw_only(),
      py::arg("components") = 20,
      "Returns the ShapeModel of aligned shapes (N, V, 3), with at most so many components.");
  module.def("measure_shape_model",
             &QualityPython,
             py::arg("shapes"),
             py::kw_only(),
             py::arg("components") = 20,
             py::arg("samples") = 1000,
             py::arg("seed") = 1,
             R"(Measures the models of aligned shapes (N, V, 3) with 1, 2, ... components.

Returns a dict: "generalization", the mean distance of a shape from the model of all others, with its
standard error; "specificity", that of a random shape of the model from the nearest shape; "shapes",
the number that was measured. Distances are root mean squares over the vertices.)");
  module.def("compare_groups",
             &ComparePython,
             py::arg("shapes"),
             py::arg("groups"),
             py::kw_only(),
             py::arg("permutations") = 1000,
             py::arg("seed") = 1,
             R"(Tests at each vertex whether aligned shapes (N, V, 3) differ by group.

`groups` has a label for each shape. Returns a dict of arrays (V,): "difference" of the means,
"statistic" (F), "p" by random permutations, and "p_corrected" for the number of vertices.)");
}

}  // namespace ceres_ed::python
