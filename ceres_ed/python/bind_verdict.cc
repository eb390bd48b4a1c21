// Binds the verdict on a fit, and the findings of the checks before it.
#include <ceres_ed/pipeline/verdict.h>
#include <ceres_ed/preflight/finding.h>
#include <ceres_ed/python/bindings.h>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

namespace py = pybind11;

py::list Reasons(const Verdict& verdict) {
  py::list reasons;
  for (const VerdictReason& reason : verdict.reasons) {
    py::dict entry;
    entry["code"] = reason.code;
    entry["text"] = reason.text;
    entry["value"] = reason.value;
    entry["bound"] = reason.bound;
    reasons.append(entry);
  }
  return reasons;
}

}  // namespace

void BindVerdict(py::module_& module) {
  py::class_<Verdict>(
      module, "Verdict", "Whether a result can be trusted, from what can be seen without truth.")
      .def_property_readonly(
          "grade",
          [](const Verdict& self) { return NameOf(self.grade); },
          "'good', 'doubtful' or 'bad': that of the worst figure.")
      .def_property_readonly(
          "reasons",
          &Reasons,
          "The figures that are not as they should be, a dict for each: code (a word for "
          "programs), text (a sentence), value, and bound (where the figure becomes better).")
      .def_property_readonly(
          "advice",
          [](const Verdict& self) { return self.advice; },
          "What can be tried, a sentence each.")
      .def("__repr__",
           [](const Verdict& self) { return "<ceres_ed.Verdict: " + self.Sentence() + ">"; });

  py::class_<Finding>(module, "Finding", "A fault of an input, as ed_check names it.")
      .def_readonly("code", &Finding::code, "A word for programs.")
      .def_property_readonly(
          "severity",
          [](const Finding& self) { return NameOf(self.severity); },
          "'warning', or 'note' if a fit copes with it by itself.")
      .def_readonly("text", &Finding::text, "What is wrong, and how much of it.")
      .def_readonly("fix", &Finding::fix, "What to do about it.")
      .def_readonly("value", &Finding::value, "The figure by which it was found.")
      .def("__repr__", [](const Finding& self) {
        return "<ceres_ed.Finding " + self.code + ": " + self.text + ">";
      });
}

}  // namespace ceres_ed::python
