// Analytic bodies for tests, sample data and simulated sequences.
#ifndef CERES_ED_SIMULATION_SHAPES_H_
#define CERES_ED_SIMULATION_SHAPES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/simulation/solid.h>

#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

enum class SyntheticShape { kPlane, kDolphin, kHeart, kKidney, kStomach };

// Returns every shape, in the order of the enumeration.
const std::vector<SyntheticShape>& AllSyntheticShapes();

// Returns "plane", "dolphin", "heart", "kidney" or "stomach".
const char* SyntheticShapeName(SyntheticShape shape);

// Returns the shape of that name, nothing if there is none.
std::optional<SyntheticShape> SyntheticShapeFromName(const std::string& name);

// Returns the usual size of a shape in metres: 1 for the dolphin, 0.2 for the plane, 0.1 for
// organs.
double DefaultSyntheticSize(SyntheticShape shape);

// Returns the body in its own unit (about 1 long), centred near the origin. Not for the plane.
//   dolphin: beak toward +x, dorsal fin toward +z; organs: top toward +z, front toward -y.
SyntheticSolid MakeSyntheticSolid(SyntheticShape shape);

// Returns a mesh of about `vertices` (>= 500, within 10 %) vertices, without normals.
//
// `size` > 0 scales the shape's own unit to metres: the plane is size x size in z = 0 with normals
// toward +z, a body is about `size` long. Bodies are closed, manifold and oriented outward; no two
// vertices coincide. The same arguments give the same mesh.
PointCloud MakeSyntheticShape(SyntheticShape shape, int vertices, double size);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SHAPES_H_
