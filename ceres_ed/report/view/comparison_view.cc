#include "ceres_ed/report/view/comparison_view.h"

#include <cstddef>
#include <utility>

namespace ceres_ed {

namespace {

// Keeps only the last moment of a surface.
void StandStill(ViewSurface* surface) {
  const std::size_t count = surface->points.size();
  PointMoments& moments = *surface->moments;
  for (ScalarField& field : surface->fields) {
    if (field.values.size() == count) continue;
    field.values.erase(field.values.begin(),
                       field.values.end() - static_cast<std::ptrdiff_t>(count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_there = moments.IsThere(static_cast<int>(i), moments.count - 1);
    moments.first[i] = is_there ? 0 : 1;
    moments.last[i] = 0;
  }
  moments.count = 1;
  moments.places.clear();
}

}  // namespace

Scene CompareScenes(const std::vector<const Scene*>& scenes,
                    const std::vector<std::string>& names) {
  Scene all;
  const ViewSurface* target = nullptr;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (scenes[i]->surfaces.empty()) continue;
    ViewSurface result = scenes[i]->surfaces[0];
    result.points = PointsAt(result, 1.0);
    result.motion.reset();
    if (result.moments) StandStill(&result);
    result.name = names[i];
    all.panels.push_back({names[i], static_cast<int>(all.surfaces.size()), 1.0, false, true});
    all.surfaces.push_back(std::move(result));
    if (all.first_field.empty()) all.first_field = scenes[i]->first_field;
    if (target == nullptr && scenes[i]->surfaces.size() > 1) target = &scenes[i]->surfaces[1];
  }
  if (target != nullptr) {
    all.panels.push_back({"Target", static_cast<int>(all.surfaces.size()), 1.0, false, false});
    all.surfaces.push_back(*target);
  }
  SetRanges(&all);
  return all;
}

}  // namespace ceres_ed
