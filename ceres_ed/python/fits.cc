#include "ceres_ed/python/fits.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/pipeline/check/check_files.h>
#include <ceres_ed/pipeline/fit/fit_run.h>
#include <ceres_ed/pipeline/fit/fit_verdict.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace ceres_ed::python {

std::vector<Landmark> ToLandmarks(const py::object& object) {
  std::vector<Landmark> landmarks;
  if (object.is_none()) return landmarks;
  py::object indices, positions;
  if (py::isinstance<py::dict>(object)) {
    indices = py::list(object.attr("keys")());
    positions = py::list(object.attr("values")());
  } else if (py::isinstance<py::tuple>(object) && py::len(object) == 2) {
    indices = py::tuple(object)[0];
    positions = py::tuple(object)[1];
  } else {
    throw py::type_error(
        "landmarks: expected {source point: (x, y, z)} or a pair "
        "(source points (N,), positions (N, 3))");
  }
  const std::vector<int> points = ToIndices(indices, "landmarks' source points");
  if (points.empty()) return landmarks;
  const std::vector<Eigen::Vector3d> places = ToPoints(positions, "landmarks' positions");
  if (places.size() != points.size()) {
    throw py::value_error("landmarks: " + std::to_string(points.size()) + " source points and " +
                          std::to_string(places.size()) + " positions, expected equal numbers");
  }
  for (std::size_t i = 0; i < points.size(); ++i) landmarks.push_back({points[i], places[i]});
  return landmarks;
}

void Judge(const Documents& documents,
           const std::function<bool()>& should_stop,
           const StatusOr<FitResult>& result,
           FittedSurface* fitted) {
  if (!result.ok()) return;
  const FitInput& input = fitted->input;
  const bool has_target = !input.target.empty();
  fitted->checks = CheckFiles({"source", &input.source, documents.source},
                              {has_target ? "target" : "", &input.target, documents.target},
                              should_stop);
  fitted->verdict = JudgeFit({&*result,
                              Diagonal(input.source.points),
                              has_target ? Diagonal(input.target.points) : 0.0,
                              MeasureLandmarks(input, *result).rms});
}

void Conclude(StatusOr<FitResult> result, FittedSurface* fitted) {
  fitted->result = ValueOrThrow(std::move(result));
  if (!fitted->result.IsUsable()) throw std::runtime_error(fitted->result.message);
  // The target is not needed any more.
  fitted->input.target = PointCloud();
}

}  // namespace ceres_ed::python
