#include "ceres_ed/report/view/view_surface.h"

#include <ceres_ed/report/view/decimation.h>

#include <utility>

namespace ceres_ed {

const ScalarField* ViewSurface::Find(const std::string& key) const {
  for (const ScalarField& field : fields) {
    if (field.key == key) return &field;
  }
  return nullptr;
}

std::size_t ViewSurface::IndexOf(const ScalarField& field, int point, double at) const {
  const auto index = static_cast<std::size_t>(point);
  if (!moments || field.values.size() == points.size()) return index;
  return static_cast<std::size_t>(moments->MomentAt(at)) * points.size() + index;
}

ViewSurface MakeViewSurface(const std::string& name,
                            const PointCloud& cloud,
                            const std::vector<int>& rows,
                            int max_points,
                            const std::vector<int>& must_keep,
                            std::vector<int>* kept) {
  Decimation decimation = Decimate(cloud.points, cloud.triangles, max_points, must_keep);
  ViewSurface surface;
  surface.name = name;
  surface.all_points = static_cast<int>(cloud.points.size());
  surface.all_triangles = static_cast<int>(cloud.triangles.size());
  for (const int point : decimation.kept) {
    surface.points.push_back(cloud.points[point]);
    surface.rows.push_back(rows.empty() ? point : rows[point]);
  }
  surface.triangles = std::move(decimation.triangles);
  *kept = std::move(decimation.kept);
  return surface;
}

std::vector<double> TakeKept(const std::vector<double>& values, const std::vector<int>& kept) {
  std::vector<double> taken;
  taken.reserve(kept.size());
  for (const int point : kept) taken.push_back(values[point]);
  return taken;
}

}  // namespace ceres_ed
