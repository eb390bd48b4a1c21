#include "ceres_ed/report/view/comparison_view.h"

#include <cstddef>
#include <utility>

namespace ceres_ed {

Scene CompareScenes(const std::vector<const Scene*>& scenes,
                    const std::vector<std::string>& names) {
  Scene all;
  const ViewSurface* target = nullptr;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (scenes[i]->surfaces.empty()) continue;
    ViewSurface result = scenes[i]->surfaces[0];
    result.points = PointsAt(result, 1.0);
    result.motion.reset();
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
