#include "ceres_ed/slam/tissue_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SVD>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// Weight of a moment that isn't like the present at all: what is left is the mean.
constexpr double kLeastLikeness = 1e-6;
// Mean square distance from a line, squared map units, from which on nodes tell a turn.
constexpr double kLeastExtent = 1.0;

Eigen::Vector3d PlaceOf(const DeformableMap& map, int node, const Eigen::Vector3d& translation) {
  return map.graph().position(node) + translation;
}

}  // namespace

// Sums over the nodes that are in view now and were at a moment: places then (p) and now (q).
struct TissueMemory::Comparison {
  int common = 0;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  Eigen::Matrix3d qp = Eigen::Matrix3d::Zero();
  double squares = 0.0;

  void Add(const Eigen::Vector3d& then, const Eigen::Vector3d& now) {
    ++common;
    p += then;
    q += now;
    qp += now * then.transpose();
    squares += then.squaredNorm() + now.squaredNorm();
  }
};

TissueMemory::Alignment TissueMemory::Align(const Comparison& c) {
  Alignment alignment;
  alignment.common = c.common;
  if (c.common == 0) return alignment;
  const double n = c.common;
  const Eigen::Matrix3d covariance = c.qp - c.q * c.p.transpose() / n;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
  // Few nodes, or nodes in a line, say nothing of a turn.
  if (svd.singularValues()[1] > kLeastExtent * n) {
    alignment.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  }
  alignment.translation = (c.q - alignment.rotation * c.p) / n;
  const double spread = c.squares - (c.p.squaredNorm() + c.q.squaredNorm()) / n;
  const double explained = (alignment.rotation.transpose() * covariance).trace();
  alignment.difference = std::max(0.0, (spread - 2.0 * explained) / n);
  return alignment;
}

void TissueMemory::BeginFrame(const NodeSet& observed, DeformableMap* map) {
  anchored_.Clear();
  for (const int node : observed.nodes()) {
    map->SetNodePrior(node, NodeTranslation(map->state().node(node)));
    anchored_.Add(node);
  }
}

void TissueMemory::Look(const NodeSet& observed, const DeformableMap& map) {
  std::vector<Comparison> comparisons(nodes_of_moment_.size());
  for (const int node : observed.nodes()) {
    anchored_.Add(node);
    if (node >= static_cast<int>(traces_.size())) continue;
    const Eigen::Vector3d now = map.NodePosition(node);
    for (const Trace& trace : traces_[node]) {
      comparisons[trace.moment / stride_].Add(PlaceOf(map, node, trace.translation), now);
    }
  }
  alignments_.clear();
  for (const Comparison& c : comparisons) alignments_.push_back(Align(c));
  JudgeLikeness();
}

void TissueMemory::JudgeLikeness() {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Alignment& a : alignments_) {
    if (a.common >= options_.min_common) nearest = std::min(nearest, a.difference);
  }
  double width = options_.likeness * options_.likeness;
  if (std::isfinite(nearest)) width = std::max(width, nearest);
  for (Alignment& a : alignments_) {
    a.likeness = kLeastLikeness;
    if (a.common == 0) continue;
    const double share = std::min(1.0, a.common / static_cast<double>(options_.min_common));
    a.likeness += share * std::exp(-0.5 * a.difference / width);
  }
}

Eigen::Vector3d TissueMemory::Recall(int node, const DeformableMap& map) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (const Trace& trace : traces_[node]) {
    const Alignment& now_from_then = alignments_[trace.moment / stride_];
    sum +=
        now_from_then.likeness * (now_from_then.rotation * PlaceOf(map, node, trace.translation) +
                                  now_from_then.translation);
    total += now_from_then.likeness;
  }
  return sum / total - map.graph().position(node);
}

void TissueMemory::UpdatePriors(const std::vector<int>& nodes, DeformableMap* map) {
  for (const int node : nodes) {
    if (anchored_.Has(node)) continue;
    if (node < static_cast<int>(traces_.size()) && !traces_[node].empty()) {
      map->SetNodePrior(node, Recall(node, *map));
    } else {
      map->SetNodePrior(node, NodeTranslation(map->state().node(node)));
      anchored_.Add(node);
    }
  }
}

const std::vector<int>& TissueMemory::Affected() {
  affected_.Clear();
  for (std::size_t k = 0; k < alignments_.size(); ++k) {
    if (alignments_[k].common == 0) continue;
    for (const int node : nodes_of_moment_[k]) {
      if (!anchored_.Has(node)) affected_.Add(node);
    }
  }
  affected_.Sort();
  return affected_.nodes();
}

void TissueMemory::Keep(const NodeSet& observed, const DeformableMap& map) {
  const int moment = next_moment_++;
  if (moment % stride_ != 0) return;
  while (static_cast<int>(traces_.size()) < map.graph().num_nodes()) traces_.emplace_back();
  nodes_of_moment_.push_back(observed.nodes());
  for (const int node : observed.nodes()) {
    traces_[node].push_back({moment, NodeTranslation(map.state().node(node))});
  }
  if (++kept_ > options_.max_moments) Thin();
}

// All of the map, but only whenever the number of moments has doubled.
void TissueMemory::Thin() {
  stride_ *= 2;
  kept_ = (next_moment_ - 1) / stride_ + 1;
  const auto goes = [this](const Trace& trace) { return trace.moment % stride_ != 0; };
  for (std::vector<Trace>& trace : traces_) {
    trace.erase(std::remove_if(trace.begin(), trace.end(), goes), trace.end());
  }
  ListNodes();
}

void TissueMemory::ListNodes() {
  nodes_of_moment_.assign(kept_, {});
  for (int j = 0; j < static_cast<int>(traces_.size()); ++j) {
    for (const Trace& trace : traces_[j]) nodes_of_moment_[trace.moment / stride_].push_back(j);
  }
}

}  // namespace ceres_ed
