// Binds fit().
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/fits.h>
#include <ceres_ed/python/memory.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/python/surfaces.h>
#include <ceres_ed/registration/fit.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

// Fits, looks at the inputs, and judges the result.
StatusOr<FitResult> FitWithoutLock(const Documents& documents,
                                   FitOptions options,
                                   const EnergyArguments& energies,
                                   const py::object& progress,
                                   Callbacks* callbacks,
                                   FittedSurface* fitted) {
  options.should_stop = [callbacks, errors = energies.errors.get()] {
    return errors->failed() || callbacks->ShouldStop();
  };
  if (!progress.is_none()) {
    options.on_progress = [callbacks, &progress](const FitProgress& state) {
      callbacks->Call([&] { progress(state); });
    };
  }
  const py::gil_scoped_release release;
  StatusOr<FitResult> result = Fit(fitted->input, options, energies.registry);
  Judge(documents, options.rigid.initial_scale, options.should_stop, result, fitted);
  return result;
}

// The function has one parameter for each of Python's. NOLINTNEXTLINE(readability-function-size)
std::unique_ptr<FittedSurface> FitSurfaces(const py::object& source,
                                           const py::object& target,
                                           const py::object& landmarks,
                                           const py::object& fixed,
                                           const py::object& energies,
                                           const py::object& plugin,
                                           const FitOptions* options,
                                           const py::object& progress,
                                           const py::object& should_stop,
                                           const py::object& source_landmarks,
                                           const py::object& target_landmarks,
                                           const std::string& landmark_use,
                                           const std::string& mesh_space,
                                           const py::kwargs& changes) {
  auto fitted = std::make_unique<FittedSurface>();
  FitInput& input = fitted->input;
  SurfaceArgument surface(source, "source");
  fitted->colors = surface.colors();
  Documents documents;
  documents.source = surface.document();
  input.source = std::move(surface).Take();
  std::optional<SurfaceArgument> target_surface;
  if (!target.is_none()) {
    target_surface.emplace(target, "target");
    documents.target = target_surface->document();
    input.target = std::move(*target_surface).Take();
  }
  input.landmarks = ToLandmarks(landmarks);
  const std::vector<std::string> warnings = AddNamedLandmarks(
      {source_landmarks, target_landmarks, landmark_use, mesh_space}, documents, fitted.get());
  if (!fixed.is_none()) input.fixed_points = ToIndices(fixed, "fixed");
  FitOptions changed = options != nullptr ? *options : FitOptions();
  OptionsClass<FitOptions>::Apply("fit", changes, &changed);
  const EnergyArguments added = ToEnergies(energies, plugin);
  changed.extra_energies = added.specs;
  ExpectLargeBlocks();
  Callbacks callbacks(should_stop);
  StatusOr<FitResult> result =
      FitWithoutLock(documents, changed, added, progress, &callbacks, fitted.get());
  added.errors->Rethrow();
  callbacks.Rethrow();
  Conclude(std::move(result), warnings, fitted.get());
  return fitted;
}

void BindProgress(py::module_& module) {
  py::class_<FitProgress>(module, "FitProgress", "The progress of a fit.")
      .def_readonly("stage", &FitProgress::stage, "'rigid' or 'fit'.")
      .def_readonly(
          "fraction", &FitProgress::fraction, "The part of the fit that is done, in [0, 1].")
      .def_readonly("inliers", &FitProgress::inliers, "The number of accepted matches.")
      .def_readonly(
          "rms_plane",
          &FitProgress::rms_plane,
          "The root mean square point-to-plane distance of the inliers, in the target's unit.")
      .def_readonly("energy", &FitProgress::energy, "The objective, without unit.")
      .def("__repr__", [](const FitProgress& self) {
        return "<ceres_ed.FitProgress " + self.stage + ": " +
               std::to_string(static_cast<int>(100.0 * self.fraction)) + " %>";
      });
}

}  // namespace

void BindFit(py::module_& module) {
  BindProgress(module);
  module.def("fit",
             &FitSurfaces,
             py::arg("source"),
             py::arg("target") = py::none(),
             py::kw_only(),
             py::arg("landmarks") = py::none(),
             py::arg("fixed") = py::none(),
             py::arg("energies") = py::none(),
             py::arg("plugin") = py::none(),
             py::arg("options") = nullptr,
             py::arg("progress") = py::none(),
             py::arg("should_stop") = py::none(),
             py::arg("source_landmarks") = py::none(),
             py::arg("target_landmarks") = py::none(),
             py::arg("landmark_use") = "fit",
             py::arg("mesh_space") = "auto",
             R"(Deforms `source` to lie on `target`, or to bring its landmarks to their positions.

Other Python threads run during the fit. Ctrl-C, and an exception in `progress` or `should_stop`,
end the fit and are raised. The result does not depend on the number of threads.

Args:
  source, target: surfaces of any kind (see Cloud), in the same unit. Without a target, the source
    is fitted to the landmarks alone.
  landmarks: the positions of source points in the target's frame: {source point: (x, y, z)}, or a
    pair (source points (N,), positions (N, 3)).
  fixed: (N,) source points that do not move. If there are any, there is no rigid motion.
  energies: additional energies: a str as in ed_fit --energy ('floor:weight=1e4,height=-0.1;...'),
    an Energy, a PointEnergy (a function of Python), or a list of these.
  plugin: the path of a shared object with more energies, or a list of paths.
  options: a FitOptions. Its options may also be given as keywords, which take precedence.
  progress: a function that is called with a FitProgress after each round.
  should_stop: a function that is called often, without arguments. If it returns True, the fit ends
    with the best result so far.
  source_landmarks, target_landmarks: points with the same names on both surfaces: Landmarks,
    {name: (x, y, z)}, or the path of a file (.mrk.json, .fcsv, .json, .pts, .csv). They need not be
    vertices; FitResult.landmark_errors says how far each of them is off.
  landmark_use: 'fit': they draw the fit; 'measure': they only measure it.
  mesh_space: 'LPS' or 'RAS': the axes of both surfaces, into which landmarks of the other space are
    turned. 'auto': what a surface's file says, otherwise LPS.

Returns: a FitResult.
Raises:
  ValueError: an input, an option or an energy can't be used. The text says what was expected.
  OSError: a plugin can't be read.
  RuntimeError: there is no usable result.)");
}

}  // namespace ceres_ed::python
