// Binds the fitter of one source to many targets.
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/fits.h>
#include <ceres_ed/python/options.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace ceres_ed::python {
namespace {

// The class SurfaceFitter.
class Fitter {
 public:
  Fitter(const py::object& source,
         const FitOptions* options,
         const py::object& energies,
         const py::object& plugin,
         const py::kwargs& changes)
      : source_(source, "source"), energies_(ToEnergies(energies, plugin)) {
    FitOptions changed = options != nullptr ? *options : FitOptions();
    OptionsClass<FitOptions>::Apply("SurfaceFitter", changes, &changed);
    changed.extra_energies = energies_.specs;
    initial_scale_ = changed.rigid.initial_scale;
    // A fit of a SurfaceFitter has its options, also these. The calls of one fit find their
    // callbacks here, so that the fitter serves one thread at a time.
    changed.should_stop = [this] {
      return energies_.errors->failed() || (callbacks_ != nullptr && callbacks_->ShouldStop());
    };
    fitter_ =
        ValueOrThrow(SurfaceFitter::Create(std::move(source_).Take(), changed, energies_.registry));
  }

  std::unique_ptr<FittedSurface> Fit(const py::object& target,
                                     const py::object& landmarks,
                                     const py::object& fixed,
                                     const py::object& should_stop,
                                     const py::object& source_landmarks,
                                     const py::object& target_landmarks,
                                     const std::string& landmark_use,
                                     const std::string& mesh_space) {
    if (callbacks_ != nullptr) {
      throw std::runtime_error("the fitter is in use by another thread");
    }
    auto fitted = std::make_unique<FittedSurface>();
    FitInput& input = fitted->input;
    std::optional<SurfaceArgument> target_surface;
    Documents documents;
    if (!target.is_none()) {
      target_surface.emplace(target, "target");
      documents.target = target_surface->document();
      input.target = std::move(*target_surface).Take();
    }
    input.source = fitter_->source();
    input.landmarks = ToLandmarks(landmarks);
    documents.source = source_.document();
    const std::vector<std::string> warnings = AddNamedLandmarks(
        {source_landmarks, target_landmarks, landmark_use, mesh_space}, documents, fitted.get());
    if (!fixed.is_none()) input.fixed_points = ToIndices(fixed, "fixed");
    Callbacks callbacks(should_stop);
    const auto fit = [&] {
      callbacks_ = &callbacks;
      const py::gil_scoped_release release;
      StatusOr<FitResult> result = fitter_->Fit(input.target, input.landmarks, input.fixed_points);
      Judge(
          documents,
          initial_scale_,
          [&callbacks] { return callbacks.ShouldStop(); },
          result,
          fitted.get());
      return result;
    };
    StatusOr<FitResult> result = fit();
    callbacks_ = nullptr;
    energies_.errors->Rethrow();
    callbacks.Rethrow();
    fitted->colors = source_.colors();
    Conclude(std::move(result), warnings, fitted.get());
    return fitted;
  }

  std::size_t size() const { return fitter_->source().size(); }

 private:
  // The points have moved to `fitter_`.
  SurfaceArgument source_;
  EnergyArguments energies_;
  double initial_scale_ = 1.0;
  std::unique_ptr<SurfaceFitter> fitter_;
  // Of the fit that runs; null between fits. Changed with the interpreter's lock only.
  Callbacks* callbacks_ = nullptr;
};

}  // namespace

void BindFitter(py::module_& module) {
  py::class_<Fitter>(module, "SurfaceFitter", R"(Fits one source to many targets.

What depends on the source alone (normals, connectivity, search structures) is computed once. The
results are those of fit(), with the same bits. One thread at a time may use a fitter.)")
      .def(py::init<const py::object&,
                    const FitOptions*,
                    const py::object&,
                    const py::object&,
                    const py::kwargs&>(),
           py::arg("source"),
           py::arg("options") = nullptr,
           py::kw_only(),
           py::arg("energies") = py::none(),
           py::arg("plugin") = py::none(),
           R"(Takes the source and the options of all fits.

The options of FitOptions may be given as keywords, which take precedence over `options`. `energies`
and `plugin` are those of fit(). Raises a ValueError for what can't be used.)")
      .def("fit",
           &Fitter::Fit,
           py::arg("target") = py::none(),
           py::kw_only(),
           py::arg("landmarks") = py::none(),
           py::arg("fixed") = py::none(),
           py::arg("should_stop") = py::none(),
           py::arg("source_landmarks") = py::none(),
           py::arg("target_landmarks") = py::none(),
           py::arg("landmark_use") = "fit",
           py::arg("mesh_space") = "auto",
           "Returns the FitResult of the source on `target`. Arguments and errors are those of the "
           "function fit().")
      .def("__len__", &Fitter::size, "Returns the number of points of the source.")
      .def("__repr__", [](const Fitter& self) {
        return "<ceres_ed.SurfaceFitter of " + std::to_string(self.size()) + " points>";
      });
}

}  // namespace ceres_ed::python
