#include "ceres_ed/python/pickles.h"

#include <ceres_ed/python/archive.h>
#include <ceres_ed/version.h>

#include <cstring>
#include <string>
#include <string_view>

namespace ceres_ed::python {

namespace py = pybind11;

// The members of each struct. A structured binding names all of them, so that a struct with a new
// member does not compile until the member is added here. T may be const.
#define CERES_ED_FIELDS(Type, ...)                    \
  template <typename Archive>                         \
  void Fields(Archive& archive, Type& object) {       \
    auto& [__VA_ARGS__] = object;                     \
    archive(__VA_ARGS__);                             \
  }                                                   \
  template <typename Archive>                         \
  void Fields(Archive& archive, const Type& object) { \
    auto& [__VA_ARGS__] = object;                     \
    archive(__VA_ARGS__);                             \
  }

CERES_ED_FIELDS(RigidTransform, rotation, translation)
CERES_ED_FIELDS(Similarity, scale, rotation, translation)
CERES_ED_FIELDS(LossSpec, type, width)
CERES_ED_FIELDS(EnergySpec, name, weight, loss, parameters)
CERES_ED_FIELDS(GraphEdge, from, to, weight)
CERES_ED_FIELDS(BindingOptions, neighbors, distance, num_threads)
CERES_ED_FIELDS(VertexField, points, displacements)
CERES_ED_FIELDS(PointCloud, points, normals, normals_oriented, intensities, triangles)
CERES_ED_FIELDS(Landmark, point, position)
CERES_ED_FIELDS(PlyProperty, name, type, values, is_list, list_count_type, list_sizes)
CERES_ED_FIELDS(PlyElement, name, count, properties)
CERES_ED_FIELDS(PlyDocument, format, comments, obj_info, elements, warnings)
CERES_ED_FIELDS(LoadedCloud, cloud, document, vertex_of_point, warnings)
CERES_ED_FIELDS(FitInput, source, target, landmarks, fixed_points)
CERES_ED_FIELDS(Correspondence, point, detail, target, normal, weight)
CERES_ED_FIELDS(
    MatchDetail, source_normal, target_normal, source_intensity, target_intensity, gradient)
CERES_ED_FIELDS(Matches, correspondences, details, candidates, inliers, plane, distance, robust)
CERES_ED_FIELDS(TermEnergy, label, weighted, raw, residuals)
CERES_ED_FIELDS(EnergySummary, terms)
CERES_ED_FIELDS(FitRound, stiffness, inliers, rms_plane, energy)
CERES_ED_FIELDS(FitTimes, prepare, rigid, graph, associate, build, solve, level1, level2, finish)
CERES_ED_FIELDS(FitUncertainty, covariances, undetermined_nodes, time)
CERES_ED_FIELDS(CoverEvidence, matched, missed, unseen)
CERES_ED_FIELDS(FitEvidence,
                measured,
                source,
                target,
                residual,
                noise,
                edge_stretch,
                node_stretch,
                folded,
                bend,
                bend_matched,
                relief,
                rigid_score,
                rigid_runner_up,
                rigid_curvature,
                disagreement)

void Fields(ArchiveWriter& archive, const DeformationGraph& graph) {
  archive(graph.num_inner_nodes(),
          std::vector<Eigen::Vector3d>(graph.positions().begin(), graph.positions().end()),
          std::vector<GraphEdge>(graph.edges().begin(), graph.edges().end()));
}
void Fields(ArchiveReader& archive, DeformationGraph& graph) {
  int inner = 0;
  std::vector<Eigen::Vector3d> positions;
  std::vector<GraphEdge> edges;
  archive(inner, positions, edges);
  const int num_nodes = static_cast<int>(positions.size());
  ArchiveReader::Require(inner >= 0 && inner <= num_nodes);
  graph = DeformationGraph();
  for (int j = 0; j < num_nodes; ++j) {
    j < num_nodes - inner ? graph.AddNode(positions[j]) : graph.AddInnerNode(positions[j]);
  }
  for (const GraphEdge& edge : edges) {
    ArchiveReader::Require(edge.from >= 0 && edge.from < num_nodes && edge.to >= 0 &&
                           edge.to < num_nodes && edge.from != edge.to);
    graph.AddEdge(edge);
  }
}

void Fields(ArchiveWriter& archive, const DeformationState& state) {
  archive(static_cast<std::uint64_t>(state.num_nodes()));
  for (int j = 0; j < state.num_nodes(); ++j)
    archive.Raw(state.node(j), kNodeSize * sizeof(double));
  archive(state.camera_from_map);
}
void Fields(ArchiveReader& archive, DeformationState& state) {
  state.Resize(static_cast<int>(archive.Count()));
  for (int j = 0; j < state.num_nodes(); ++j)
    archive.Raw(state.node(j), kNodeSize * sizeof(double));
  archive(state.camera_from_map);
}

void Fields(ArchiveWriter& archive, const Skinning& skinning) {
  archive(skinning.stride(), static_cast<std::uint64_t>(skinning.size()));
  for (std::size_t i = 0; i < skinning.size(); ++i) {
    const Binding binding = skinning[i];
    archive(binding.size);
    archive.Raw(binding.nodes, sizeof(int) * binding.size);
    archive.Raw(binding.weights, sizeof(double) * binding.size);
  }
}
void Fields(ArchiveReader& archive, Skinning& skinning) {
  int stride = 0;
  archive(stride);
  ArchiveReader::Require(stride >= 1 && stride <= kMaxBoundNodes);
  skinning = Skinning(stride);
  for (std::size_t count = archive.Count(); count > 0; --count) {
    int size = 0;
    int nodes[kMaxBoundNodes];
    double weights[kMaxBoundNodes];
    archive(size);
    ArchiveReader::Require(size >= 1 && size <= stride);
    archive.Raw(nodes, sizeof(int) * size);
    archive.Raw(weights, sizeof(double) * size);
    skinning.Add(nodes, weights, size);
  }
}

CERES_ED_FIELDS(Warp, graph, state, target_from_source, binding, finish, repaired)
CERES_ED_FIELDS(Graph, graph, binding, node_points, node_spacing, warnings)
CERES_ED_FIELDS(FitResult,
                status,
                message,
                warp,
                skinning,
                points,
                normals,
                rigid,
                relevant,
                active_hidden,
                held_share,
                information_lost,
                matches,
                initial,
                final,
                rounds,
                outer,
                inner,
                fixed_error,
                rigid_only,
                rigid_suffices,
                hypothesis,
                noise,
                unfolded,
                uncertainty,
                evidence,
                times,
                warnings)
CERES_ED_FIELDS(VerdictReason, code, text, value, bound)
CERES_ED_FIELDS(Verdict, grade, reasons, advice)
CERES_ED_FIELDS(Finding, code, severity, text, fix, value)
CERES_ED_FIELDS(LandmarkPair, name, source, target)
CERES_ED_FIELDS(LandmarkError, before, rigid, after)
CERES_ED_FIELDS(FittedSurface, input, colors, result, verdict, checks, pairs, errors, num_by_index)
CERES_ED_FIELDS(NamedLandmark, name, position)
CERES_ED_FIELDS(LandmarkFile::Place, begin, size)
CERES_ED_FIELDS(LandmarkFile, points, space, warnings, text, places, pointers)
CERES_ED_FIELDS(Landmarks, points, space, path, file)

#undef CERES_ED_FIELDS

void Fields(ArchiveWriter& archive, const Cloud& cloud) {
  archive(cloud.cloud, cloud.colors, cloud.file != nullptr);
  if (cloud.file != nullptr) archive(*cloud.file);
}
void Fields(ArchiveReader& archive, Cloud& cloud) {
  bool has_file = false;
  archive(cloud.cloud, cloud.colors, has_file);
  if (!has_file) return;
  cloud.file = std::make_unique<LoadedCloud>();
  archive(*cloud.file);
}

namespace {

// The bytes begin with it.
std::string Heading() { return std::string("ceres_ed ") + kVersion; }

}  // namespace

template <typename T>
py::bytes Pickle(const T& object) {
  ArchiveWriter archive;
  archive(Heading());
  archive(object);
  return archive.bytes();
}

template <typename T>
std::unique_ptr<T> Unpickle(const py::bytes& bytes) {
  ArchiveReader archive{std::string_view(bytes)};
  std::string heading;
  archive(heading);
  if (heading != Heading()) {
    throw py::value_error("the pickle is of '" + heading + "', expected '" + Heading() + "'");
  }
  auto object = std::make_unique<T>();
  archive(*object);
  ArchiveReader::Require(archive.empty());
  return object;
}

template py::bytes Pickle(const Cloud&);
template py::bytes Pickle(const EnergySpec&);
template py::bytes Pickle(const FittedSurface&);
template py::bytes Pickle(const Graph&);
template py::bytes Pickle(const Landmarks&);
template py::bytes Pickle(const Warp&);
template std::unique_ptr<Cloud> Unpickle(const py::bytes&);
template std::unique_ptr<EnergySpec> Unpickle(const py::bytes&);
template std::unique_ptr<FittedSurface> Unpickle(const py::bytes&);
template std::unique_ptr<Graph> Unpickle(const py::bytes&);
template std::unique_ptr<Landmarks> Unpickle(const py::bytes&);
template std::unique_ptr<Warp> Unpickle(const py::bytes&);

}  // namespace ceres_ed::python
