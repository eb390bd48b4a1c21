#include "ceres_ed/io/warp_io.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/warp/warp_format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <ostream>
#include <vector>

#include <glog/logging.h>
#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using nlohmann::json;

constexpr const char* kUnitsNote =
    "g and t in the unit of the source; translation in the unit of the target; A column by column";

json ToJson(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

bool AllFinite(const double* values, std::size_t size) {
  return std::all_of(values, values + size, [](double value) { return std::isfinite(value); });
}

// NaN and infinity can't be written in JSON.
Status CheckFinite(const std::string& path, const Warp& warp) {
  const Similarity& similarity = warp.target_from_source;
  if (!std::isfinite(similarity.scale) || !similarity.rotation.coeffs().allFinite() ||
      !similarity.translation.allFinite()) {
    return Status::Error(path + ": cannot write: target_from_source is not finite");
  }
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    if (!warp.graph.position(j).allFinite() || !AllFinite(warp.state.node(j), kNodeSize)) {
      return Status::Error(path + ": cannot write: node " + std::to_string(j) + " is not finite");
    }
  }
  for (int e = 0; e < warp.graph.num_edges(); ++e) {
    if (!std::isfinite(warp.graph.edges()[static_cast<std::size_t>(e)].weight)) {
      return Status::Error(path + ": cannot write: edge " + std::to_string(e) + " is not finite");
    }
  }
  for (std::size_t p = 0; p < warp.finish.points.size(); ++p) {
    if (!warp.finish.points[p].allFinite() || !warp.finish.displacements[p].allFinite()) {
      return Status::Error(path + ": cannot write: point " + std::to_string(p) +
                           " of the finish is not finite");
    }
  }
  return Status::Ok();
}

// Writes an array of JSON values, each on a line of its own.
void WriteLines(const char* name, const std::vector<json>& values, std::ostream* stream) {
  *stream << "  \"" << name << "\": [";
  for (std::size_t i = 0; i < values.size(); ++i) {
    *stream << (i == 0 ? "\n    " : ",\n    ") << values[i].dump();
  }
  *stream << "\n  ]";
}

void WriteFinish(const VertexField& field, std::ostream* stream) {
  std::vector<json> points;
  for (std::size_t p = 0; p < field.points.size(); ++p) {
    const Eigen::Vector3d& at = field.points[p];
    const Eigen::Vector3d& move = field.displacements[p];
    points.push_back({at.x(), at.y(), at.z(), move.x(), move.y(), move.z()});
  }
  *stream << ",\n  \"finish\": {\n";
  WriteLines("points", points, stream);
  *stream << "\n  }";
}

}  // namespace

Status WriteWarp(const std::string& path, const Warp& warp) {
  CHECK_EQ(warp.graph.num_nodes(), warp.state.num_nodes());
  CHECK_EQ(warp.finish.points.size(), warp.finish.displacements.size());
  Status finite = CheckFinite(path, warp);
  if (!finite.ok()) return finite;
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  if (!file.ok()) return file.status();

  const Eigen::Quaterniond& rotation = warp.target_from_source.rotation;
  const json similarity = {{"scale", warp.target_from_source.scale},
                           {"rotation", {rotation.w(), rotation.x(), rotation.y(), rotation.z()}},
                           {"translation", ToJson(warp.target_from_source.translation)}};
  const bool on_surface = warp.binding.distance == DistanceRule::kSurface;
  const json binding = {{"neighbors", warp.binding.neighbors},
                        {"distance", on_surface ? kSurfaceRule : kEuclideanRule}};
  std::vector<json> nodes;
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    const double* const block = warp.state.node(j);
    nodes.push_back({{"g", ToJson(warp.graph.position(j))},
                     {"A", std::vector<double>(block, block + kWarpAffineSize)},
                     {"t", std::vector<double>(block + kWarpAffineSize, block + kNodeSize)}});
  }
  std::vector<json> edges;
  for (const GraphEdge& edge : warp.graph.edges()) {
    edges.push_back(json::array({edge.from, edge.to, edge.weight}));
  }
  std::ostream& stream = (*file)->stream();
  stream << "{\n  \"format\": " << json(kWarpFormat).dump() << ",\n  \"version\": " << kWarpVersion
         << ",\n  \"units_note\": " << json(kUnitsNote).dump()
         << ",\n  \"target_from_source\": " << similarity.dump()
         << ",\n  \"binding\": " << binding.dump() << ",\n";
  WriteLines("nodes", nodes, &stream);
  stream << ",\n";
  WriteLines("edges", edges, &stream);
  if (warp.graph.num_inner_nodes() > 0) {
    stream << ",\n  \"inner_nodes\": " << warp.graph.num_inner_nodes();
  }
  if (warp.repaired) stream << ",\n  \"repaired\": true";
  if (!warp.finish.empty()) WriteFinish(warp.finish, &stream);
  stream << "\n}\n";
  return (*file)->Commit();
}

}  // namespace ceres_ed
