#include "ceres_ed/report/view/comparison_view.h"

#include <cstddef>
#include <utility>

namespace ceres_ed {

Scene CompareScenes(const std::vector<const Scene*>& scenes,
                    const std::vector<std::string>& names) {
  Scene all;
  bool has_target = false;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (scenes[i]->surfaces.empty()) continue;
    ViewSurface result = scenes[i]->surfaces[0];
    result.points = PointsAt(result, 1.0);
    result.motion.reset();
    result.name = names[i];
    all.panels.push_back({names[i], static_cast<int>(all.surfaces.size()), 1.0, false, true});
    all.surfaces.push_back(std::move(result));
    if (all.first_field.empty()) all.first_field = scenes[i]->first_field;
    if (!has_target && scenes[i]->surfaces.size() > 1) {
      has_target = true;
      all.panels.push_back({"Target", static_cast<int>(all.surfaces.size()), 1.0, false, false});
      all.surfaces.push_back(scenes[i]->surfaces[1]);
    }
  }
  SetRanges(&all);
  return all;
}

}  // namespace ceres_ed
