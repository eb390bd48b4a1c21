#include "ceres_ed/python/fits.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/pipeline/check/check_files.h>
#include <ceres_ed/pipeline/fit/fit_run.h>
#include <ceres_ed/pipeline/fit/fit_verdict.h>
#include <ceres_ed/pipeline/fit/named_landmarks.h>
#include <ceres_ed/python/landmarks.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace ceres_ed::python {
namespace {

template <typename Choice>
Choice ChoiceOf(const std::string& argument, const std::string& name) {
  const std::optional<Choice> choice = FindByName<Choice>(name);
  if (choice.has_value()) return *choice;
  throw py::value_error(argument + " is '" + name + "', expected '" + ListNames<Choice>("' or '") +
                        "'");
}

// Returns landmarks as the library matches them: at the positions that they have now.
SurfaceLandmarks OnSurface(const std::string& mesh,
                           const Landmarks& landmarks,
                           const LandmarkSurface& surface) {
  LandmarkFile file;
  file.points = landmarks.points;
  file.space = landmarks.space;
  file.warnings = landmarks.file.warnings;
  return {mesh, landmarks.path.empty() ? mesh + "_landmarks" : landmarks.path, surface, file};
}

}  // namespace

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

std::vector<std::string> AddNamedLandmarks(const NamedArguments& arguments,
                                           const Documents& documents,
                                           FittedSurface* fitted) {
  FitInput& input = fitted->input;
  fitted->num_by_index = input.landmarks.size();
  const auto use = ChoiceOf<LandmarkUse>("landmark_use", arguments.use);
  const auto space = ChoiceOf<MeshSpace>("mesh_space", arguments.mesh_space);
  if (arguments.source.is_none() != arguments.target.is_none()) {
    throw py::value_error(
        "source_landmarks and target_landmarks belong together: one is given, expected both or "
        "none");
  }
  if (arguments.source.is_none()) return {};
  const PlyDocument none;
  const LandmarkSurface source{input.source,
                               documents.source == nullptr ? none : *documents.source};
  const LandmarkSurface target{input.target,
                               documents.target == nullptr ? none : *documents.target};
  NamedLandmarks named = ValueOrThrow(MatchLandmarks(
      space,
      OnSurface("source",
                ToNamedLandmarks(arguments.source, "source_landmarks", LandmarkSide::kSource),
                source),
      OnSurface("target",
                ToNamedLandmarks(arguments.target, "target_landmarks", LandmarkSide::kTarget),
                target)));
  fitted->landmark_pairs = std::move(named.pairs);
  if (use == LandmarkUse::kFit && !input.source.empty()) {
    for (const Landmark& landmark : LandmarkConstraints(fitted->landmark_pairs, input.source)) {
      input.landmarks.push_back(landmark);
    }
  }
  return std::move(named.warnings);
}

void Judge(const Documents& documents,
           double initial_scale,
           const std::function<bool()>& should_stop,
           const StatusOr<FitResult>& result,
           FittedSurface* fitted) {
  if (!result.ok()) return;
  const FitInput& input = fitted->input;
  const bool has_target = !input.target.empty();
  fitted->checks = CheckFiles({"source", &input.source, documents.source},
                              {has_target ? "target" : "", &input.target, documents.target},
                              should_stop);
  fitted->landmark_errors = MeasureLandmarkPairs(
      fitted->landmark_pairs, input.source, result->points, result->rigid, initial_scale);
  const bool do_named_draw = input.landmarks.size() > fitted->num_by_index;
  fitted->verdict = JudgeFit(
      {&*result,
       Diagonal(input.source.points),
       has_target ? Diagonal(input.target.points) : 0.0,
       MeasureLandmarks(input,
                        fitted->num_by_index,
                        do_named_draw ? fitted->landmark_errors : std::vector<LandmarkError>(),
                        *result)
           .rms});
}

void Conclude(StatusOr<FitResult> result,
              const std::vector<std::string>& warnings,
              FittedSurface* fitted) {
  fitted->result = ValueOrThrow(std::move(result));
  if (!fitted->result.IsUsable()) throw std::runtime_error(fitted->result.message);
  std::vector<std::string>& all = fitted->result.warnings;
  all.insert(all.begin(), warnings.begin(), warnings.end());
  // The target is not needed any more.
  fitted->input.target = PointCloud();
}

}  // namespace ceres_ed::python
