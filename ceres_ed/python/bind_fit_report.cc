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

Theme ToTheme(const std::string& name) {
  const std::optional<Theme> theme = FindByName<Theme>(name);
  if (!theme) throw py::value_error("theme is '" + name + "', expected 'light' or 'dark'");
  return *theme;
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
  outputs.theme = ToTheme(theme);
  return outputs;
}

nlohmann::ordered_json ReportOf(const FittedSurface& fit) {
  nlohmann::ordered_json report = FitResultReport(fit.result, fit.verdict);
  report["program"] = "the Python package";
  report["version"] = kVersion;
  return report;
}

py::bytes PictureOf(const FittedSurface& fit, int width, const std::string& theme_name) {
  constexpr int kLowest = 200;
  constexpr int kHighest = 8000;
  if (width < kLowest || width > kHighest) {
    throw py::value_error("width is " + std::to_string(width) + ", expected 200 to 8000 pixels");
  }
  const Theme theme = ToTheme(theme_name);
  const auto draw = [&] {
    const py::gil_scoped_release release;
    return FitPng(ReportOf(fit), MakeFitView(PartsOfFit(fit.input, fit.result, {})), theme, width);
  };
  return draw();
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
    return WriteFitLook(outputs, ReportOf(fit), MakeFitView(parts));
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
  result.attr("picture") =
      py::cpp_function(&PictureOf,
                       py::name("picture"),
                       py::is_method(result),
                       py::kw_only(),
                       py::arg("width") = 900,
                       py::arg("theme") = "light",
                       R"(Returns the picture of report() as the bytes of a PNG file.

It is `width` pixels wide (200 to 8000). Empty if this build draws no pictures.)");
}

}  // namespace ceres_ed::python
