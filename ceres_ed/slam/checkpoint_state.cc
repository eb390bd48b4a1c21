// The data that each class of the tracking loop saves.
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/frame/feature_points.h>
#include <ceres_ed/slam/frame/foreground.h>
#include <ceres_ed/slam/levels/levels.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/map/tissue_memory.h>
#include <ceres_ed/slam/tracker.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace ceres_ed {
namespace {

void ExchangePose(const std::string& name, CameraPose* pose, CheckpointArchive* archive) {
  archive->Value(name + "_rotation", &pose->rotation);
  archive->Value(name + "_translation", &pose->translation);
}

// Exchanges the number of rows of a list, which is not known when it is loaded.
template <typename Row>
void ExchangeCount(const std::string& name,
                   std::vector<Row>* rows,
                   CheckpointArchive* archive,
                   const Row& fresh = Row()) {
  int count = static_cast<int>(rows->size());
  archive->Value(name, &count);
  if (!archive->saving()) rows->assign(static_cast<std::size_t>(std::max(0, count)), fresh);
}

void ExchangeNodes(const std::string& name, NodeSet* nodes, CheckpointArchive* archive) {
  std::vector<int> list = nodes->nodes();
  archive->Array(name, &list);
  nodes->Clear();
  for (const int node : list) nodes->Add(node);
}

}  // namespace

void DeformableMap::Exchange(CheckpointArchive* archive) {
  archive->Enter("map");
  ExchangeGraph(archive);
  ExchangePoints(archive);
  archive->Leave();
}

void DeformableMap::ExchangeGraph(CheckpointArchive* archive) {
  std::vector<Eigen::Vector3d> positions(graph_.positions().begin(), graph_.positions().end());
  ExchangeCount<Eigen::Vector3d>("nodes", &positions, archive, Eigen::Vector3d::Zero());
  archive->Column(
      "node_positions", &positions, [](auto& p) -> auto& { return p; });
  std::vector<GraphEdge> edges(graph_.edges().begin(), graph_.edges().end());
  ExchangeCount("edges", &edges, archive);
  archive->Column("edge_from", &edges, [](GraphEdge& e) -> int& { return e.from; });
  archive->Column("edge_to", &edges, [](GraphEdge& e) -> int& { return e.to; });
  archive->Column("edge_weight", &edges, [](GraphEdge& e) -> double& { return e.weight; });
  std::vector<double> parameters;
  for (int j = 0; archive->saving() && j < state_.num_nodes(); ++j) {
    parameters.insert(parameters.end(), state_.node(j), state_.node(j) + kNodeSize);
  }
  archive->Array("node_parameters", &parameters);
  std::vector<Eigen::Vector3d> priors(node_prior_.begin(), node_prior_.end());
  priors.resize(positions.size(), Eigen::Vector3d::Zero());
  archive->Column(
      "node_prior", &priors, [](auto& t) -> auto& { return t; });
  ExchangePose("camera_from_map", &state_.camera_from_map, archive);
  if (archive->saving() || !archive->status().ok()) return;
  graph_ = DeformationGraph();
  node_prior_.assign(priors.begin(), priors.end());
  for (const Eigen::Vector3d& position : positions) graph_.AddNode(position);
  for (const GraphEdge& edge : edges) graph_.AddEdge(edge);
  state_.Resize(graph_.num_nodes());
  index_ = NodeIndex();
  for (int j = 0; j < graph_.num_nodes(); ++j) {
    SetNode(j, &parameters[static_cast<std::size_t>(j) * kNodeSize]);
  }
}

void DeformableMap::ExchangePoints(CheckpointArchive* archive) {
  points_.Exchange(archive);
  // Points are visited node by node, so the order of each node's list affects the results.
  std::vector<int> owned, owned_counts;
  for (const std::vector<int>& slots : points_of_node_) {
    owned.insert(owned.end(), slots.begin(), slots.end());
    owned_counts.push_back(static_cast<int>(slots.size()));
  }
  archive->Array("owned", &owned);
  archive->Array("owned_counts", &owned_counts);
  archive->Array("free_slots", &free_slots_);
  archive->Value("num_points", &num_points_);
  archive->Value("next_id", &next_id_);
  if (archive->saving() || !archive->status().ok()) return;
  points_of_node_.clear();
  auto next = owned.begin();
  for (const int count : owned_counts) {
    points_of_node_.emplace_back(next, next + count);
    next += count;
  }
}

void CornerStore::Exchange(int num_nodes, CheckpointArchive* archive) {
  archive->Enter("corners");
  ExchangeCount("count", &corners_, archive);
  for (Corner& f : corners_) {
    // Unused places get a fixed value, so that equal states give equal bytes.
    std::fill(f.nodes + f.num_nodes, f.nodes + kMaxBoundNodes, 0);
    std::fill(f.weights + f.num_nodes, f.weights + kMaxBoundNodes, 0.0);
  }
  archive->Column(
      "pixel", &corners_, [](Corner & f) -> auto& { return f.pixel; });
  archive->Column(
      "in_camera", &corners_, [](Corner & f) -> auto& { return f.in_camera; });
  archive->Column(
      "at_rest", &corners_, [](Corner & f) -> auto& { return f.at_rest; });
  archive->Column(
      "nodes", &corners_, [](Corner & f) -> auto& { return f.nodes; });
  archive->Column(
      "weights", &corners_, [](Corner & f) -> auto& { return f.weights; });
  archive->Column("num_nodes", &corners_, [](Corner& f) -> int& { return f.num_nodes; });
  archive->Column(
      "rest_from_pixel", &corners_, [](Corner & f) -> auto& { return f.rest_from_pixel; });
  archive->Column(
      "fine", &corners_, [](Corner & f) -> auto& { return f.patch.levels[0]; });
  archive->Column(
      "coarse", &corners_, [](Corner & f) -> auto& { return f.patch.levels[1]; });
  archive->Column(
      "descriptor", &corners_, [](Corner & f) -> auto& { return f.descriptor; });
  archive->Column("weight", &corners_, [](Corner& f) -> double& { return f.weight; });
  archive->Column("misses", &corners_, [](Corner& f) -> int& { return f.misses; });
  archive->Column("birth", &corners_, [](Corner& f) -> int& { return f.birth; });
  archive->Array("followed", &followed_);
  archive->Value("births", &births_);
  archive->Leave();
  if (archive->saving()) return;
  if (!AreBound(num_nodes)) {
    archive->Fail("a corner is bound to a node that does not exist, expected nodes of the map");
    corners_.clear();
  }
  Index();
}

void FeaturePoints::Exchange(int num_nodes, CheckpointArchive* archive) {
  archive->Enter("features");
  tracker_.Exchange(archive);
  corners_.Exchange(num_nodes, archive);
  archive->Value("pictures", &frame_);
  archive->Value("continued", &num_continued_);
  archive->Leave();
}

void Levels::ForgetSolvers() {
  const ActiveSet::Contents active =
      solver_ != nullptr ? solver_->active_set().Save() : ActiveSet::Contents();
  solver_ = MakeSolver();
  solver_->active_set().Load(active);
}

void Levels::Exchange(CheckpointArchive* archive) {
  archive->Enter("levels");
  ExchangeNodes("point_relevant", &point_relevant_, archive);
  ExchangeNodes("moved", &moved_, archive);
  pending_.Exchange(archive);
  ActiveSet::Contents active = solver_->active_set().Save();
  archive->Array("active", &active.nodes);
  archive->Array("active_judged", &active.judged);
  archive->Value("active_moves_unjudged", &active.moves_unjudged);
  if (!archive->saving()) solver_->active_set().Load(active);
  archive->Leave();
}

void PendingNodes::Exchange(CheckpointArchive* archive) {
  std::vector<double> changes(changes_.begin(), changes_.end());
  archive->Array("pending", &changes);
  if (archive->saving()) return;
  changes_.clear();
  listed_.Clear();
  for (std::size_t j = 0; j < changes.size(); ++j) Set(static_cast<int>(j), changes[j]);
}

void TissueMemory::Exchange(CheckpointArchive* archive) {
  archive->Enter("memory");
  archive->Value("next_moment", &next_moment_);
  archive->Value("stride", &stride_);
  ExchangeCount("moments", &moments_, archive);
  archive->Column(
      "origin", &moments_, [](Moment & m) -> auto& { return m.origin; });
  archive->Column(
      "step", &moments_, [](Moment & m) -> auto& { return m.step; });
  // The runs and translations of all moments, one after the other.
  std::vector<int> run_counts, first, count;
  std::vector<std::array<std::uint16_t, 3>> translations;
  for (const Moment& moment : moments_) {
    run_counts.push_back(static_cast<int>(moment.runs.size()));
    for (const Run& run : moment.runs) {
      first.push_back(run.first);
      count.push_back(run.count);
    }
    translations.insert(translations.end(), moment.translations.begin(), moment.translations.end());
  }
  archive->Array("run_counts", &run_counts);
  archive->Array("run_first", &first);
  archive->Array("run_count", &count);
  archive->Rows("translations", &translations);
  archive->Leave();
  if (archive->saving() || !archive->status().ok()) return;
  alignments_.clear();
  std::size_t next_run = 0;
  auto next = translations.begin();
  for (std::size_t m = 0; m < moments_.size(); ++m) {
    Moment& moment = moments_[m];
    for (int r = 0; r < run_counts.at(m); ++r, ++next_run) {
      const Run run = {first.at(next_run), count.at(next_run)};
      moment.runs.push_back(run);
      moment.translations.insert(moment.translations.end(), next, next + run.count);
      next += run.count;
    }
  }
}

void Foreground::Exchange(CheckpointArchive* archive) {
  archive->Enter("foreground");
  // The intrinsics are those of the tracker.
  int width = cell_at_.width();
  int height = cell_at_.height();
  archive->Value("width", &width);
  archive->Value("height", &height);
  archive->Value("cell", &cell_);
  ExchangePose("camera_from_map", &camera_from_map_, archive);
  std::vector<Cell> cells = cells_;
  ExchangeCount("cells", &cells, archive);
  archive->Column("at", &cells, [](Cell& c) -> int& { return c.at; });
  archive->Column("place", &cells, [](Cell& c) -> Eigen::Vector3d& { return c.place; });
  archive->Column("now", &cells, [](Cell& c) -> Eigen::Vector3d& { return c.now; });
  archive->Column("age", &cells, [](Cell& c) -> int& { return c.age; });
  if (!archive->saving()) {
    // The surface is a grid over the picture.
    const bool is_valid = width >= 0 && height >= 0 && cell_ >= 1 &&
                          (width - 1) * cell_ < camera_.width &&
                          (height - 1) * cell_ < camera_.height &&
                          std::all_of(cells.begin(), cells.end(), [&](const Cell& cell) {
                            return cell.in_foreground() && cell.at >= 0 && cell.at < width * height;
                          });
    if (is_valid) {
      SetCells(width, height, std::move(cells));
    } else {
      SetCells(0, 0, {});
    }
  }
  archive->Leave();
}

void Tracker::Exchange(CheckpointArchive* archive) {
  archive->Enter("slam");
  archive->Value("unit", &unit_);
  archive->Value("surface_radius", &surface_radius_);
  ExchangePose("world_from_map", &world_from_map_, archive);
  ExchangePose("camera_step", &camera_step_, archive);
  archive->Value("points_before", &points_before_);
  archive->Value("proving", &proving_);
  int gap = gap_ ? 1 : 0;
  archive->Value("gap", &gap);
  gap_ = gap != 0;
  int was_still = was_still_ ? 1 : 0;
  archive->Value("was_still", &was_still);
  was_still_ = was_still != 0;
  archive->Value("nodes_before_growth", &nodes_before_growth_);
  map_.Exchange(archive);
  features_.Exchange(map_.graph().num_nodes(), archive);
  foreground_.Exchange(archive);
  memory_.Exchange(archive);
  levels_->Exchange(archive);
  if (options_.covariance) covariances_.Exchange(archive);
  archive->Leave();
  levels_->ForgetSolvers();
}

}  // namespace ceres_ed
