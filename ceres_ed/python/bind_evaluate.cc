// Binds the evaluation of a fit.
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/pipeline/evaluate/evaluate_run.h>
#include <ceres_ed/pipeline/evaluate/pair_report.h>
#include <ceres_ed/pipeline/evaluate/sequence_report.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/callbacks.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/surfaces.h>

#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

namespace py = pybind11;

Evaluation EvaluateSurfaces(const py::object& result_object,
                            const py::object& target_object,
                            const py::object& truth_object,
                            const py::object& source_object) {
  const SurfaceArgument result(result_object, "result");
  const SurfaceArgument target(target_object, "target");
  std::optional<SurfaceArgument> truth, source;
  if (!truth_object.is_none()) truth.emplace(truth_object, "truth");
  if (!source_object.is_none()) source.emplace(source_object, "source");
  const PointCloud* from = source ? &**source : nullptr;
  if (from == nullptr && py::isinstance<FittedSurface>(result_object)) {
    from = &result_object.cast<const FittedSurface&>().input.source;
  }
  const auto evaluate = [&] {
    const py::gil_scoped_release release;
    return Evaluate(*result, *target, from, truth ? &**truth : nullptr);
  };
  return ValueOrThrow(evaluate());
}

py::object ToDict(const nlohmann::ordered_json& report) {
  return py::module_::import("json").attr("loads")(
      report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

// Keeps the figures of a sequence; Ctrl-C ends the evaluation.
class SequenceObserver final : public EvaluateObserver {
 public:
  explicit SequenceObserver(Callbacks* callbacks) : callbacks_(callbacks) {}
  void OnWarning(const std::string& sentence) override { warnings.push_back(sentence); }
  bool ShouldStop() override { return callbacks_->ShouldStop(); }
  void OnSequence(const SequenceFigures& figures) override { report = SequenceReport(figures); }

  nlohmann::ordered_json report;
  std::vector<std::string> warnings;

 private:
  Callbacks* callbacks_;
};

py::object EvaluateSequenceFiles(const py::object& sequence, const py::object& result) {
  EvalSettings settings;
  settings.sequence = ToPath(sequence);
  settings.result = ToPath(result);
  Callbacks callbacks{py::none()};
  SequenceObserver observer(&callbacks);
  const auto evaluate = [&] {
    const py::gil_scoped_release release;
    return RunEvaluation(settings, &observer);
  };
  const Outcome outcome = evaluate();
  callbacks.Rethrow();
  if (!outcome.done()) throw py::value_error(outcome.message);
  observer.report["warnings"] = observer.warnings;
  return ToDict(observer.report);
}

void BindStatistics(py::module_& module) {
  using S = DistanceStatistics;
  py::class_<S>(
      module, "DistanceStatistics", "Statistics of a set of distances, in the unit of the input.")
      .def_readonly("mean", &S::mean)
      .def_readonly("rms", &S::rms)
      .def_readonly("p50", &S::p50, "The median.")
      .def_readonly("p95", &S::p95)
      .def_readonly("p99", &S::p99)
      .def_readonly("max", &S::max)
      .def_readonly("trimmed", &S::trimmed, "The mean of the smallest 80 %.")
      .def("in_percent_of",
           &S::InPercentOf,
           py::arg("diagonal"),
           "Returns the statistics in percent of a length.")
      .def("__repr__", [](const S& self) {
        return "<ceres_ed.DistanceStatistics mean " + std::to_string(self.mean) + ", p95 " +
               std::to_string(self.p95) + ", max " + std::to_string(self.max) + ">";
      });
  using C = ShapeChange;
  py::class_<C>(module, "ShapeChange", "The change of the source's edges and triangles.")
      .def_readonly(
          "edge_mean", &C::edge_mean, "The mean of |l' / l - 1| over all edges, without unit.")
      .def_readonly("edge_p95", &C::edge_p95)
      .def_readonly("edge_p99", &C::edge_p99)
      .def_readonly("edges", &C::edges, "The number of edges.")
      .def_readonly("flipped", &C::flipped, "The number of triangles that turned over.")
      .def_readonly(
          "degenerate", &C::degenerate, "The number of triangles with less than 5 % of their area.")
      .def("__repr__", [](const C& self) {
        return "<ceres_ed.ShapeChange of " + std::to_string(self.edges) + " edges: mean " +
               std::to_string(self.edge_mean) + ", " + std::to_string(self.flipped) + " flipped>";
      });
}

}  // namespace

void BindEvaluate(py::module_& module) {
  BindStatistics(module);
  using E = Evaluation;
  py::class_<E>(
      module, "Evaluation", "What evaluate() measures. Lengths are in the unit of the input.")
      .def_readonly("diagonal", &E::diagonal, "The diagonal of the target's bounding box.")
      .def_readonly(
          "forward", &E::forward, "Distances from the result's points to the target's surface.")
      .def_readonly(
          "backward", &E::backward, "Distances from the target's points to the result's surface.")
      .def_readonly("symmetric", &E::symmetric, "Both directions together.")
      .def_readonly("nearest_forward",
                    &E::nearest_forward,
                    "Distances from the result's points to the nearest points of the target.")
      .def_readonly("nearest_backward",
                    &E::nearest_backward,
                    "Distances from the target's points to the nearest points of the result.")
      .def_readonly("point_to_plane",
                    &E::point_to_plane,
                    "The mean distance to the planes of the nearest points; None without normals "
                    "or triangles.")
      .def_readonly("normal_error_deg",
                    &E::normal_error_deg,
                    "The mean angle to the normals of these points in degrees; None unless both "
                    "surfaces have normals or triangles.")
      .def_readonly("truth",
                    &E::truth,
                    "Distances from the points to their true positions; None without a truth.")
      .def_readonly("shape", &E::shape, "The change of the mesh; None without a source.")
      .def(
          "as_dict",
          [](const E& self) { return ToDict(EvaluationReport(self)); },
          "Returns all figures as a dict, as in the report of ed_eval.")
      .def("__repr__", [](const E& self) {
        return "<ceres_ed.Evaluation: mean " + std::to_string(self.symmetric.mean) + ", p95 " +
               std::to_string(self.symmetric.p95) + ">";
      });
  module.def("evaluate_sequence",
             &EvaluateSequenceFiles,
             py::arg("sequence"),
             py::arg("result"),
             R"(Returns what ed_eval measures on the result of ed_slam, as a dict.

`sequence` is the folder of the sequence, `result` that of the result (ed_slam --output). The
entries are those of the report of ed_eval: truth, camera, depth, tracks_2d and log, each None
where the sequence has nothing to compare with, and warnings. Lengths are in metres. Raises a
ValueError that names the file that can't be used.)");
  module.def("evaluate",
             &EvaluateSurfaces,
             py::arg("result"),
             py::arg("target"),
             py::arg("truth") = py::none(),
             py::arg("source") = py::none(),
             R"(Returns the Evaluation of `result` against `target`.

All arguments are surfaces (see Cloud). `truth` has the true positions of the result's points, and
`source` their positions before the fit, both in the same order. For a FitResult, the default of
`source` is its own source. Raises a ValueError for a surface without points and for unequal numbers
of points.)");
}

}  // namespace ceres_ed::python
