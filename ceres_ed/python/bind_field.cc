// Binds the displacement fields of warps: as arrays, and as files for other tools.
#include <ceres_ed/io/field/field_format.h>
#include <ceres_ed/pipeline/apply/field_run.h>
#include <ceres_ed/preflight/repair.h>
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/callbacks.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/python/surfaces.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

// The class Field: a field, and what is known of it.
struct Field {
  MadeField made;
  bool is_inverse = false;
};

// Ends the run after Ctrl-C.
class InterruptObserver : public FieldObserver {
 public:
  bool ShouldStop() override { return callbacks_.ShouldStop(); }
  void Rethrow() { callbacks_.Rethrow(); }

 private:
  Callbacks callbacks_{py::none()};
};

FieldSettings ToSettings(const char* caller, const py::object& options, const py::kwargs& changes) {
  FieldSettings settings;
  if (!options.is_none()) settings = options.cast<FieldSettings>();
  OptionsClass<FieldSettings>::Apply(caller, changes, &settings);
  std::string error;
  if (!FieldSettings::Rows().Check(settings, &error)) throw py::value_error(error);
  return settings;
}

// Returns the cloud around which the grid lies; nothing for None.
std::optional<PointCloud> CloudAround(const py::object& around, const Warp& warp) {
  if (around.is_none()) return std::nullopt;
  PointCloud cloud = SurfaceArgument(around, "around").Take();
  if (warp.repaired) RepairCloud("around", &cloud);
  return cloud;
}

void ThrowUnlessDone(const Outcome& outcome, InterruptObserver* observer) {
  observer->Rethrow();
  if (!outcome.done()) throw py::value_error(outcome.message);
}

std::unique_ptr<Field> MakeFieldFor(const FieldSettings& settings,
                                    const FieldFormat& format,
                                    const Warp& warp,
                                    const py::object& around) {
  const std::optional<PointCloud> cloud = CloudAround(around, warp);
  InterruptObserver observer;
  auto field = std::make_unique<Field>();
  field->is_inverse = settings.inverse;
  const auto make = [&] {
    const py::gil_scoped_release release;
    return MakeField(settings,
                     format,
                     "warp",
                     warp,
                     cloud.has_value() ? &*cloud : nullptr,
                     &observer,
                     &field->made);
  };
  ThrowUnlessDone(make(), &observer);
  return field;
}

// Files of VTK have the coordinates of the surfaces, which is what arrays have.
std::unique_ptr<Field> FieldOf(const Warp& warp,
                               const py::object& around,
                               const py::object& options,
                               const py::kwargs& changes) {
  FieldSettings settings = ToSettings("Warp.field", options, changes);
  settings.field = "field";
  return MakeFieldFor(settings, **FieldFormatOf("field.vti"), warp, around);
}

std::unique_ptr<Field> WriteFieldOf(const Warp& warp,
                                    const py::object& path,
                                    const py::object& around,
                                    const py::object& options,
                                    const py::kwargs& changes) {
  FieldSettings settings = ToSettings("Warp.write_field", options, changes);
  settings.field = ToPath(path);
  const FieldFormat* format = ValueOrThrow(FieldFormatOf(settings.field));
  std::unique_ptr<Field> field = MakeFieldFor(settings, *format, warp, around);
  const auto write = [&] {
    const py::gil_scoped_release release;
    return format->write(settings.field, field->made.field);
  };
  ThrowUnlessWritten(write());
  return field;
}

void WriteRigidOf(const Warp& warp,
                  const py::object& path,
                  const std::string& frame,
                  const std::string& unit) {
  py::dict changes;
  changes["frame"] = frame;
  changes["unit"] = unit;
  FieldSettings settings = ToSettings("Warp.write_rigid", py::none(), py::kwargs(changes));
  settings.rigid = ToPath(path);
  FieldObserver silent;
  const Outcome outcome = RunField(settings, "warp", warp, nullptr, &silent);
  if (!outcome.done()) ThrowUnlessWritten(Status::Error(outcome.message));
}

// Numpy's order of the axes is that of the memory: k, j, i, component.
py::array Vectors(const py::object& self) {
  DisplacementField& field = self.cast<Field&>().made.field;
  const std::array<int, 3>& size = field.grid.size;
  return ReadOnly(py::array_t<float>({size[2], size[1], size[0], 3}, field.vectors.data(), self));
}

py::array Vector(const Eigen::Vector3d& vector) {
  return ReadOnly(py::array_t<double>(3, vector.data()));
}

py::array Direction(const Field& self) {
  py::array_t<double> direction({3, 3});
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(direction.mutable_data()) =
      self.made.field.grid.direction;
  return ReadOnly(std::move(direction));
}

py::array ApplyField(const Field& self, const py::object& points) {
  std::vector<Eigen::Vector3d> moved = ToPoints(points, "points");
  for (Eigen::Vector3d& point : moved) {
    const auto displacement = InterpolateField(self.made.field, point);
    point +=
        displacement.value_or(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
  return OwnedView(std::move(moved));
}

py::dict ErrorOf(const Field& self) {
  const FieldError& error = self.made.about.error;
  py::dict entry;
  entry["mean"] = error.mean;
  entry["max"] = error.max;
  entry["points"] = error.num_points;
  return entry;
}

py::object InverseOf(const Field& self) {
  if (!self.is_inverse) return py::none();
  const InverseQuality& inverse = self.made.about.inverse;
  py::dict entry;
  entry["mean_residual"] = inverse.mean_residual;
  entry["max_residual"] = inverse.max_residual;
  entry["without"] = inverse.num_without;
  entry["folded"] = inverse.num_folded;
  return std::move(entry);
}

std::string Repr(const Field& self) {
  const std::array<int, 3>& size = self.made.field.grid.size;
  return "<ceres_ed.Field of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
         std::to_string(size[2]) + " points, " + (self.is_inverse ? "inverse" : "forward") +
         (self.made.about.is_lps ? ", in LPS and mm>" : ">");
}

void BindFieldClass(py::module_& module) {
  py::class_<Field>(module, "Field", R"(A displacement for each point of a grid.

The point (i, j, k) lies at origin + direction @ (spacing * (i, j, k)), and is mapped to itself plus
`vectors[k, j, i]`. Coordinates are those of the surfaces; those of a field that was written to a
medical format are left-posterior-superior in mm.)")
      .def_property_readonly("vectors",
                             &Vectors,
                             "The displacements, (K, J, I, 3) float32; a view that cannot be "
                             "written. NaN where the field has no value.")
      .def_property_readonly(
          "origin",
          [](const Field& self) { return Vector(self.made.field.grid.origin); },
          "The position of the first point, (3,).")
      .def_property_readonly(
          "spacing",
          [](const Field& self) { return Vector(self.made.field.grid.spacing); },
          "The distances of points along the three axes, (3,).")
      .def_property_readonly(
          "direction", &Direction, "(3, 3): its columns are the axes of the grid, of unit length.")
      .def_property_readonly(
          "inverse",
          &InverseOf,
          "Of an inverse field, a dict: mean_residual and max_residual, in spacings, and the "
          "number "
          "of points `without` an inverse and of those where the warp is `folded`. None for a "
          "forward field.")
      .def_property_readonly(
          "error",
          &ErrorOf,
          "How far the interpolated field misses the warp at the points of the surface, a dict: "
          "mean and max, in spacings, and the number of points.")
      .def_property_readonly(
          "description",
          [](const Field& self) { return self.made.field.description; },
          "What is mapped to what, in which frame: the line in the header of files.")
      .def("apply",
           &ApplyField,
           py::arg("points"),
           "Returns points (N, 3) with the displacements between those of the grid, by linear "
           "interpolation; NaN outside the grid.")
      .def("__repr__", &Repr);
}

}  // namespace

void BindField(py::module_& module) {
  const OptionsClass<FieldSettings> options(module,
                                            "FieldOptions",
                                            R"(The options of a displacement field.

Each option is an attribute, and a keyword of this class, of Warp.field() and of Warp.write_field().
It has the name of the flag of ed_apply.)",
                                            {"field", "rigid"});
  BindFieldClass(module);
  auto warp = py::reinterpret_borrow<py::class_<Warp>>(module.attr("Warp"));
  warp.def("field",
           &FieldOf,
           py::arg("around") = py::none(),
           py::arg("options") = py::none(),
           R"(Returns the displacements of a grid, as a Field in the coordinates of the surfaces.

`around` is a surface in the source's frame that the grid surrounds (see Cloud); None is the warp's
own nodes. With inverse=True the field maps the target to the source. The options of FieldOptions
may be given as keywords, which take precedence over `options`. Raises a ValueError for what can't
be used.)")
      .def("write_field",
           &WriteFieldOf,
           py::arg("path"),
           py::arg("around") = py::none(),
           py::arg("options") = py::none(),
           R"(Writes a displacement field for other tools, as ed_apply --field does, and returns it.

The ending of `path` is .nrrd, .nii, .nii.gz, .mha, .mhd or .h5 (left-posterior-superior, in mm), or
.vti (the coordinates of the surfaces). The other arguments are those of field(). Raises a ValueError
for what can't be used, and an OSError if the file can't be written.)")
      .def("write_rigid",
           &WriteRigidOf,
           py::arg("path"),
           py::kw_only(),
           py::arg("frame") = "lps",
           py::arg("unit") = "mm",
           R"(Writes the rigid placement target_from_source.

A .tfm is a transform of ITK, which maps the target to the source, as ITK resamples, in LPS and mm;
any other ending is a 4 x 4 matrix in text. `frame` ('lps' or 'ras') and `unit` ('mm', 'cm' or 'm')
are those of the surfaces. Raises an OSError if the file can't be written.)");
}

}  // namespace ceres_ed::python
