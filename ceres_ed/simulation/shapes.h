// Analytic bodies for tests, sample data and simulated sequences.
#ifndef CERES_ED_SIMULATION_SHAPES_H_
#define CERES_ED_SIMULATION_SHAPES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/simulation/solid.h>

#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// The shapes that can be made.
enum class SyntheticShape { kPlane, kDolphin, kHeart, kKidney, kStomach };

// Returns every shape, in the order of the enumeration.
const std::vector<SyntheticShape>& AllSyntheticShapes();

// Returns "plane", "dolphin", "heart", "kidney" or "stomach".
const char* SyntheticShapeName(SyntheticShape shape);

// Returns the shape with that name, or nothing if there is none.
std::optional<SyntheticShape> SyntheticShapeFromName(const std::string& name);

// Returns the usual size of a shape in metres: 1 for the dolphin, 0.2 for the plane, 0.1 for the
// organs.
double DefaultSyntheticSize(SyntheticShape shape);

// Returns the body in its own unit (about 1 long), centred near the origin. The plane is not a body
// and CHECK-fails. For the dolphin the beak points toward +x and the dorsal fin toward +z; for
// organs the top points toward +z and the front toward -y.
SyntheticSolid MakeSyntheticSolid(SyntheticShape shape);

// Returns a mesh with about `vertices` (>= 500, met within 10 %) vertices, without normals.
//
// `size` > 0 scales the shape's own unit to metres: the plane is size x size in z = 0 with normals
// toward +z, and a body is about `size` long. Bodies are closed, manifold and oriented outward, and
// no two vertices coincide. The same arguments give the same mesh.
PointCloud MakeSyntheticShape(SyntheticShape shape, int vertices, double size);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SHAPES_H_
