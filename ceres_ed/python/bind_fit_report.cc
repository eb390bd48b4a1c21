// Binds the page and the picture of a fit.
#include <ceres_ed/pipeline/fit/fit_picture.h>
#include <ceres_ed/pipeline/fit/fit_report.h>
#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/surfaces.h>
#include <ceres_ed/version.h>

#include <optional>
#include <string>

namespace ceres_ed::python {
namespace {

namespace py = pybind11;

bool EndsWith(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

LookOutputs OutputsOf(const std::string& path, const std::string& theme) {
  LookOutputs outputs;
  if (EndsWith(path, ".html")) {
    outputs.html = path;
  } else if (EndsWith(path, ".png")) {
    outputs.png = path;
  } else {
    throw py::value_error(path + ": expected a name that ends in .html or .png");
  }
  const std::optional<Theme> known = FindByName<Theme>(theme);
  if (!known) throw py::value_error("theme is '" + theme + "', expected 'light' or 'dark'");
  outputs.theme = *known;
  return outputs;
}

void WriteReportOf(const FittedSurface& fit,
                   const py::object& path,
                   const py::object& truth_object,
                   const std::string& theme) {
  const LookOutputs outputs = OutputsOf(ToPath(path), theme);
  ThrowUnlessOk(CheckLookOutputs(outputs));
  std::optional<SurfaceArgument> truth;
  if (!truth_object.is_none()) truth.emplace(truth_object, "truth");
  if (truth && (**truth).size() != fit.result.points.size()) {
    throw py::value_error("truth has " + std::to_string((**truth).size()) + " points, expected " +
                          std::to_string(fit.result.points.size()));
  }
  const auto write = [&] {
    const py::gil_scoped_release release;
    FitParts parts = PartsOfFit(fit.input, fit.result, {});
    if (truth) parts.truth = &(**truth).points;
    nlohmann::ordered_json report = FitResultReport(fit.input, fit.result);
    report["program"] = "the Python package";
    report["version"] = kVersion;
    return WriteFitLook(outputs, report, MakeFitView(parts));
  };
  ThrowUnlessWritten(write());
}

}  // namespace

void BindFitReport(py::module_& module) {
  const py::object result = module.attr("FitResult");
  result.attr("report") = py::cpp_function(&WriteReportOf,
                                           py::name("report"),
                                           py::is_method(result),
                                           py::arg("path"),
                                           py::kw_only(),
                                           py::arg("truth") = py::none(),
                                           py::arg("theme") = "light",
                                           R"(Writes what there is to look at of the fit.

Args:
  path: .html, a page for a browser; or .png, a picture of the same views.
  truth: a surface with the true positions of the points, in their order (see Cloud).
  theme: 'light' or 'dark', the ground of a picture.)");
}

}  // namespace ceres_ed::python
