#include "ceres_ed/pipeline/fit/fit_picture.h"

#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/report/view/fit_view.h>

#include <string>

namespace ceres_ed {

FitParts PartsOfFit(const FitInput& input, const FitResult& result, const std::vector<int>& rows) {
  FitParts parts;
  parts.source = &input.source;
  parts.target = input.target.empty() ? nullptr : &input.target;
  parts.result = &result.points;
  parts.triangles = &input.source.triangles;
  parts.warp = &result.warp;
  parts.skinning = &result.skinning;
  // A fit that was stopped early knows nothing of its nodes.
  const bool has_nodes =
      static_cast<int>(result.point_relevant.size()) == result.warp.graph.num_nodes();
  parts.point_relevant = has_nodes ? &result.point_relevant : nullptr;
  if (!result.uncertainty.covariances.empty()) {
    parts.std_dev = result.uncertainty.StandardDeviations();
  }
  parts.rows = rows;
  for (const Landmark& landmark : input.landmarks) {
    const int row = rows.empty() ? landmark.point : rows[landmark.point];
    parts.landmarks.push_back({"vertex " + std::to_string(row), landmark});
  }
  return parts;
}

Status WriteFitPictures(const FitRun& run, const nlohmann::ordered_json& report) {
  const FitSettings& settings = *run.settings;
  if (!settings.IsLookedAt()) return Status::Ok();
  const FitView view =
      MakeFitView(PartsOfFit(run.files->input, *run.result, run.files->vertex_of_point));
  return WriteFitLook({settings.html, settings.png, settings.theme}, report, view);
}

}  // namespace ceres_ed
