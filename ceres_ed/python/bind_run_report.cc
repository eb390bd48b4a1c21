// Binds the pages and pictures of finished runs.
#include <ceres_ed/pipeline/report/report_run.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>

#include <optional>
#include <string>
#include <vector>

namespace ceres_ed::python {
namespace {

namespace py = pybind11;

// Keeps the sentences until Python can have them.
class WarningKeeper : public RunObserver {
 public:
  void OnWarning(const std::string& sentence) override { sentences.push_back(sentence); }

  std::vector<std::string> sentences;
};

void WriteReportOfRuns(const py::object& runs,
                       const py::object& html,
                       const py::object& png,
                       const py::object& truth,
                       const std::string& theme) {
  ReportSettings settings;
  const bool is_list = py::isinstance<py::list>(runs) || py::isinstance<py::tuple>(runs);
  if (is_list) {
    for (const py::handle run : runs) {
      settings.runs.push_back(ToPath(py::reinterpret_borrow<py::object>(run)));
    }
  } else {
    settings.runs.push_back(ToPath(runs));
  }
  if (!html.is_none()) settings.html = ToPath(html);
  if (!png.is_none()) settings.png = ToPath(png);
  if (!truth.is_none()) settings.truth = ToPath(truth);
  if (settings.html.empty() && settings.png.empty()) {
    throw py::value_error("neither html nor png is given, expected one of them");
  }
  const std::optional<Theme> known = FindByName<Theme>(theme);
  if (!known) throw py::value_error("theme is '" + theme + "', expected 'light' or 'dark'");
  settings.theme = *known;
  WarningKeeper keeper;
  Outcome outcome;
  {
    const py::gil_scoped_release release;
    outcome = RunReport(settings, &keeper);
  }
  if (!outcome.done()) throw py::value_error(outcome.message);
  for (const std::string& sentence : keeper.sentences) {
    if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 1) != 0) throw py::error_already_set();
  }
}

}  // namespace

void BindRunReport(py::module_& module) {
  module.def("report",
             &WriteReportOfRuns,
             py::arg("runs"),
             py::kw_only(),
             py::arg("html") = py::none(),
             py::arg("png") = py::none(),
             py::arg("truth") = py::none(),
             py::arg("theme") = "light",
             R"(Writes what there is to look at of finished runs, as ed_report does.

Args:
  runs: the report.json of a run of ed_fit, ed_slam or ed_eval, or a folder with one; a list of
    several is compared.
  html: the page to write.
  png: the picture to write.
  truth: a PLY file with the true positions of the points of a fit, in their order.
  theme: 'light' or 'dark', the ground of the picture.

Raises ValueError if a run cannot be read or a file cannot be written. Files of a run that are
missing are warnings.)");
}

}  // namespace ceres_ed::python
