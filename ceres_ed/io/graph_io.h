// Writes a deformation graph as a PLY, so that it can be displayed.
#ifndef CERES_ED_IO_GRAPH_IO_H_
#define CERES_ED_IO_GRAPH_IO_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

struct GraphWriteOptions {
  PlyFormat format = PlyFormat::kBinaryLittleEndian;
  // The transform of the deformed positions g_j + t_j into the frame of the file.
  Similarity output_from_graph;
  // For each node, whether it is PR; empty means that none is.
  std::vector<bool> is_point_relevant;
  // If true, adds uchar red green blue: orange for a PR node, blue for a PI node.
  bool with_colors = false;
};

// Writes the graph to `path`: element 'vertex' has float x y z (deformed position), int pr (1 for a
// PR node) and float rest_x rest_y rest_z (g_j in the frame of the graph); element 'edge' has int
// vertex1 vertex2 and float alpha, for each directed edge. Positions that floats
// cannot hold, far from the origin, are double. The error gives the system's reason.
Status WriteGraph(const std::string& path,
                  const DeformationGraph& graph,
                  const DeformationState& state,
                  const GraphWriteOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_IO_GRAPH_IO_H_
