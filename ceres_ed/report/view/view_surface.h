// A surface to look at: few enough points for a page, each with its figures.
#ifndef CERES_ED_REPORT_VIEW_VIEW_SURFACE_H_
#define CERES_ED_REPORT_VIEW_VIEW_SURFACE_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/report/view/point_moments.h>
#include <ceres_ed/report/view/scalar_field.h>
#include <ceres_ed/report/view/warp_motion.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A page shows at most about this many points of a surface.
inline constexpr int kMaxViewPoints = 40000;

struct ViewSurface {
  // What people read, for example "source".
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  // The row of each point in its file.
  std::vector<int> rows;
  // The numbers of points and triangles before the decimation.
  int all_points = 0;
  int all_triangles = 0;
  std::vector<ScalarField> fields;
  // The own colour of each point, and its normal (0 where it is not known); empty if they are not
  // known.
  std::vector<Rgb> colors;
  std::vector<Eigen::Vector3d> normals;
  // The distance of neighbouring points, which says how large points without faces are drawn; 0 if
  // it is not known.
  double spacing = 0.0;
  // How the points move, by a warp or from moment to moment; nothing for a surface that stands
  // still.
  std::optional<WarpMotion> motion;
  std::optional<PointMoments> moments;

  bool IsDecimated() const { return all_points > static_cast<int>(points.size()); }
  // Returns the field of that key, or null.
  const ScalarField* Find(const std::string& key) const;
  // Returns whether a point is there at `at` of the way of the surface.
  bool IsThere(int point, double at) const {
    return !moments || moments->IsThere(point, moments->MomentAt(at));
  }
  // Returns the place of the value of a point in `field`, which may have one for each moment.
  std::size_t IndexOf(const ScalarField& field, int point, double at) const;
};

// Returns `cloud` with about `max_points` points, and writes their indices in `cloud` to `kept`.
// `rows` has the row of each point in its file; if it is empty, these are the indices. The points
// `must_keep` (indices) stay.
ViewSurface MakeViewSurface(const std::string& name,
                            const PointCloud& cloud,
                            const std::vector<int>& rows,
                            int max_points,
                            const std::vector<int>& must_keep,
                            std::vector<int>* kept);

// Returns the values at `kept`.
std::vector<double> TakeKept(const std::vector<double>& values, const std::vector<int>& kept);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_VIEW_SURFACE_H_
