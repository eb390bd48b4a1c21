#include "ceres_ed/pipeline/fit/fit_picture.h"

#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/report/view/fit_view.h>

#include <string>

namespace ceres_ed {
namespace {

FitParts PartsOf(const FitRun& run) {
  const FitInput& input = run.files->input;
  const FitResult& result = *run.result;
  FitParts parts;
  parts.source = &input.source;
  parts.target = input.target.empty() ? nullptr : &input.target;
  parts.result = &result.points;
  parts.triangles = &input.source.triangles;
  parts.warp = &result.warp;
  parts.skinning = &result.skinning;
  parts.point_relevant = &result.point_relevant;
  if (!result.uncertainty.covariances.empty()) {
    parts.std_dev = result.uncertainty.StandardDeviations();
  }
  parts.rows = run.files->vertex_of_point;
  for (const Landmark& landmark : input.landmarks) {
    const int row = run.files->vertex_of_point[landmark.point];
    parts.landmarks.push_back({"vertex " + std::to_string(row), landmark});
  }
  return parts;
}

}  // namespace

Status WriteFitPictures(const FitRun& run, const nlohmann::ordered_json& report) {
  const FitSettings& settings = *run.settings;
  if (!settings.IsLookedAt()) return Status::Ok();
  return WriteFitLook(
      {settings.html, settings.png, settings.theme}, report, MakeFitView(PartsOf(run)));
}

}  // namespace ceres_ed
