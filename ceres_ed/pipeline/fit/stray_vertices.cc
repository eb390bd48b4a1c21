#include "ceres_ed/pipeline/fit/stray_vertices.h"

#include <ceres_ed/geometry/stray_points.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace ceres_ed {
namespace {

// Removes `points` and says so; `what` continues "3 vertices".
void LeaveOut(const std::string& path,
              const std::vector<int>& points,
              const std::string& what,
              LoadedCloud* loaded) {
  if (points.empty()) return;
  const int first = points.front();
  // Adding zero turns -0 into 0.
  const Eigen::Vector3d at = loaded->cloud.points[first].array() + 0.0;
  std::ostringstream warning;
  warning << path << ": " << points.size() << (points.size() == 1 ? " vertex " : " vertices ")
          << what << " left out (first: vertex " << loaded->vertex_of_point[first] << " at "
          << at.x() << " " << at.y() << " " << at.z() << ')';
  std::vector<int>& rows = loaded->vertex_of_point;
  for (const int point : points) rows[point] = -1;
  rows.erase(std::remove(rows.begin(), rows.end(), -1), rows.end());
  const int triangles = RemovePoints(points, &loaded->cloud);
  if (triangles > 0) {
    warning << ", with " << triangles << (triangles == 1 ? " triangle" : " triangles");
  }
  loaded->warnings.push_back(warning.str());
}

}  // namespace

void LeaveOutStrayVertices(const std::string& path, LoadedCloud* loaded) {
  LeaveOut(path, UnmeasuredPoints(loaded->cloud), "at 0 0 0 that were not measured", loaded);
  LeaveOut(path, FarPoints(loaded->cloud), "far from all others", loaded);
}

}  // namespace ceres_ed
