#include "ceres_ed/io/sequence/layouts/stir_truth.h"

#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layouts/stir_clip.h>
#include <ceres_ed/io/sequence/picture_files.h>

#include <algorithm>
#include <utility>

namespace ceres_ed {

std::vector<Eigen::Vector2d> RegionCenters(const MaskImage& mask) {
  std::vector<Eigen::Vector2d> centers;
  MaskImage rest = mask;
  std::vector<std::pair<int, int>> open;
  for (int v = 0; v < mask.height(); ++v) {
    for (int u = 0; u < mask.width(); ++u) {
      if (rest(u, v) == 0) continue;
      // Take everything that is connected with this pixel.
      Eigen::Array2i low(u, v);
      Eigen::Array2i high(u, v);
      open.assign(1, {u, v});
      rest(u, v) = 0;
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        low = low.min(Eigen::Array2i(x, y));
        high = high.max(Eigen::Array2i(x, y));
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (!rest.Contains(x + dx, y + dy) || rest(x + dx, y + dy) == 0) continue;
            rest(x + dx, y + dy) = 0;
            open.emplace_back(x + dx, y + dy);
          }
        }
      }
      // As the challenge has it: a whole number, rounded up.
      const Eigen::Array2i center = low + (high - low + 1) / 2;
      centers.emplace_back(center.x(), center.y());
    }
  }
  return centers;
}

StatusOr<std::optional<StirPoints>> ReadStirPoints(const std::string& directory) {
  const StatusOr<std::string> clip = FindStirClip(directory);
  if (!clip.ok()) return std::optional<StirPoints>();
  const std::string start = JoinPath(*clip, "segmentation/icgstartseg.png");
  if (!IsFile(start)) return std::optional<StirPoints>();
  StirPoints points;
  points.clip = *clip;
  const StatusOr<MaskImage> first = ReadMaskImage(start);
  if (!first.ok()) return first.status();
  points.start = RegionCenters(*first);
  const std::string end = JoinPath(*clip, "segmentation/icgendseg.png");
  if (IsFile(end)) {
    const StatusOr<MaskImage> last = ReadMaskImage(end);
    if (!last.ok()) return last.status();
    points.end = RegionCenters(*last);
  }
  return std::optional<StirPoints>(std::move(points));
}

}  // namespace ceres_ed
