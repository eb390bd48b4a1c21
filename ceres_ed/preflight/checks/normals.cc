#include "ceres_ed/preflight/check_table.h"

#include <ceres_ed/geometry/orientation.h>

#include <cmath>

namespace ceres_ed {
namespace {

// Sharp edges and noise cause this share of contradictions.
constexpr double kHarmlessShare = 0.02;

}  // namespace

void CheckNormals(const Specimen& specimen, std::vector<Finding>* findings) {
  const PointCloud& cloud = *specimen.cloud;
  if (!cloud.HasNormals()) return;
  const double share = cloud.HasTriangles() ? ShareOfNormalsAgainstTriangles(cloud)
                                            : ShareOfContradictingNormals(cloud);
  if (share <= kHarmlessShare) return;
  findings->push_back({"normals",
                       Severity::kNote,
                       specimen.name + ": " + std::to_string(std::lround(100.0 * share)) +
                           " % of the normals contradict " +
                           (cloud.HasTriangles() ? "the triangles" : "those of their neighbours"),
                       "a fit computes them anew where it must; leave them out of the file",
                       share});
}

}  // namespace ceres_ed
