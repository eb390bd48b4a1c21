// A surface of a fit, with a consistent orientation.
#ifndef CERES_ED_REGISTRATION_PREPARED_SURFACE_H_
#define CERES_ED_REGISTRATION_PREPARED_SURFACE_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/surface.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// A surface whose windings and normals agree with each other as far as they can.
struct PreparedSurface {
  std::unique_ptr<const Surface> surface;
  // A sentence for each contradiction that was removed.
  std::vector<std::string> notes;
};

// Returns the surface of `cloud`, which must not be empty. Its points keep their positions and
// their order; these are changed:
//   - Triangles that are wound against their neighbours are reversed.
//   - Normals that are zero are computed, from the triangles or from the neighbouring points.
//   - If most normals point to the inner side of the triangles, all triangles are reversed; if more
//     than 2 % of the others still do, all normals are computed from the triangles.
//   - If normals of neighbouring bare points point to opposite sides, their signs are chosen anew
//     (ChooseNormalSigns()). Where this leaves contradictions, normals_oriented becomes false.
// `name` is the noun of the notes ("the target"). `should_stop` is asked before each long step; if
// it returns true, the surface stays as it is then, and its normals are zero where none were given.
PreparedSurface PrepareSurface(PointCloud cloud,
                               const std::string& name,
                               int num_threads,
                               const std::function<bool()>& should_stop = {});

// Returns the surface of `surface` turned inside out.
std::unique_ptr<const Surface> Reversed(const Surface& surface, int num_threads);

// Returns whether both surfaces are closed meshes, and sets `opposite` to whether one of them is
// wound inside out.
bool AreBothClosed(const Surface& source, const Surface& target, bool* opposite);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_PREPARED_SURFACE_H_
