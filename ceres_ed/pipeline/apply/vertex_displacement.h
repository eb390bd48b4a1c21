// A warp as a displacement of each vertex.
#ifndef CERES_ED_PIPELINE_APPLY_VERTEX_DISPLACEMENT_H_
#define CERES_ED_PIPELINE_APPLY_VERTEX_DISPLACEMENT_H_

#include <ceres_ed/io/cloud_io.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the document of `loaded` at rest with three more columns of its vertices,
// displacement_0 to displacement_2: `moved`, which has a position for each point of the cloud,
// minus the point. Vertices that are not in the cloud have zeros. Columns of that name are
// replaced. An obj_info line says that the columns are one array of vectors, named displacement, in
// VTK.
PlyDocument WithDisplacement(const LoadedCloud& loaded, const std::vector<Eigen::Vector3d>& moved);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_APPLY_VERTEX_DISPLACEMENT_H_
