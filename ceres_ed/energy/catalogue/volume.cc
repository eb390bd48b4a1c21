// Keeps the volume of a closed mesh.
#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/point_energy.h>
#include <ceres_ed/geometry/topology.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <cost_functions/volume_cost.h>

namespace ceres_ed {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

// Returns whether the triangles enclose a volume: each edge between two positions must have as many
// triangles on one side as on the other. Points at the same position count as one.
bool IsClosed(const std::vector<Eigen::Vector3d>& points, const Triangles& triangles) {
  const std::vector<int> welded = WeldPoints(points);
  std::vector<std::pair<int, int>> edges;
  std::vector<std::pair<int, int>> opposite;
  for (const std::array<int, 3>& t : triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const int from = welded[t[corner]];
      const int to = welded[t[(corner + 1) % 3]];
      if (from == to) continue;
      edges.emplace_back(from, to);
      opposite.emplace_back(to, from);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(opposite.begin(), opposite.end());
  return !edges.empty() && edges == opposite;
}

void AddVolume(const EnergyContext& context, ResidualSink* sink) {
  if (context.triangles == nullptr) return;
  const std::vector<Eigen::Vector3d>& points = *context.points;
  const Triangles& triangles = *context.triangles;
  if (!IsClosed(points, triangles)) return;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) {
    origin += point / static_cast<double>(points.size());
    box.extend(point);
  }
  const double volume = EnclosedVolume(points, triangles, origin);
  // Two sheets that lie back to back enclose no volume.
  constexpr double kNothing = 1e-9;
  if (!(std::abs(volume) > kNothing * std::pow(box.diagonal().norm(), 3))) return;

  // The nodes of all vertices, each of them once, are the parameter blocks.
  std::vector<int> block_of_node(context.graph->num_nodes(), -1);
  std::vector<BlockRef> blocks;
  std::vector<VolumeCost::Vertex> vertices;
  vertices.reserve(points.size());
  for (int v = 0; v < static_cast<int>(points.size()); ++v) {
    const Binding binding = (*context.skinning)[v];
    vertices.push_back({BindContextPoint(context, v), {}});
    for (int i = 0; i < binding.size; ++i) {
      int& block = block_of_node[binding.nodes[i]];
      if (block < 0) {
        block = static_cast<int>(blocks.size());
        blocks.push_back(BlockRef::Node(binding.nodes[i]));
      }
      vertices.back().blocks[i] = block;
    }
  }
  const int num_nodes = static_cast<int>(blocks.size());
  sink->Add(std::make_unique<VolumeCost>(std::move(vertices), triangles, volume, num_nodes),
            blocks.data(),
            num_nodes);
}

}  // namespace

Status RegisterVolume(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "volume";
  info.summary = "a closed mesh keeps the volume that it has at rest";
  info.equation = "(V - V_0) / V_0, V = sum a.(b x c) / 6 over the faces";
  info.unit = "-";
  return registry->Register(
      info, [](const ParameterValues&) { return MakeEnergy(EnergyKind::kPrior, AddVolume); });
}

}  // namespace ceres_ed
