#include "ceres_ed/slam/map/tissue_memory.h"

#include <ceres_ed/util/memory_use.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/SVD>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// The weight of a moment without any similarity. If there are only such moments, the result is
// their mean.
constexpr double kLeastLikeness = 1e-6;
// The smallest mean square distance of nodes from a line, in squared map units, that determines a
// rotation.
constexpr double kLeastExtent = 1.0;
// The largest step number of a component of a translation.
constexpr double kMostSteps = 65535.0;

Eigen::Vector3d PlaceOf(const DeformableMap& map, int node, const Eigen::Vector3d& translation) {
  return map.graph().position(node) + translation;
}

std::vector<int> ByNumber(std::vector<int> nodes) {
  if (!std::is_sorted(nodes.begin(), nodes.end())) std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

Eigen::Vector3d TissueMemory::Moment::Translation(std::size_t row) const {
  const std::array<std::uint16_t, 3>& steps = translations[row];
  return origin + step.cwiseProduct(Eigen::Vector3d(steps[0], steps[1], steps[2]));
}

TissueMemory::Moment TissueMemory::MakeMoment(const std::vector<int>& nodes,
                                              const DeformableMap& map) {
  Moment moment;
  if (nodes.empty()) return moment;
  const auto translation = [&map](int node) { return NodeTranslation(map.state().node(node)); };
  moment.origin = translation(nodes[0]);
  Eigen::Vector3d high = moment.origin;
  int num_runs = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    num_runs += k == 0 || nodes[k] != nodes[k - 1] + 1;
    const Eigen::Vector3d t = translation(nodes[k]);
    moment.origin = moment.origin.cwiseMin(t);
    high = high.cwiseMax(t);
  }
  moment.step = (high - moment.origin) / kMostSteps;
  moment.runs.reserve(num_runs);
  moment.translations.reserve(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (k == 0 || nodes[k] != nodes[k - 1] + 1) moment.runs.push_back({nodes[k], 0});
    ++moment.runs.back().count;
    const Eigen::Vector3d t = translation(nodes[k]);
    std::array<std::uint16_t, 3> steps = {};
    for (int i = 0; i < 3; ++i) {
      // If all nodes have the same value, the step is zero.
      if (!(moment.step[i] > 0.0)) continue;
      const double along = (t[i] - moment.origin[i]) / moment.step[i];
      steps[i] = static_cast<std::uint16_t>(std::clamp(std::round(along), 0.0, kMostSteps));
    }
    moment.translations.push_back(steps);
  }
  return moment;
}

template <typename Visit>
void TissueMemory::VisitCommon(const Moment& moment, const std::vector<int>& nodes, Visit visit) {
  auto next = nodes.begin();
  std::size_t row = 0;
  for (const Run& run : moment.runs) {
    next = std::lower_bound(next, nodes.end(), run.first);
    if (next == nodes.end()) return;
    for (; next != nodes.end() && *next < run.first + run.count; ++next) {
      visit(static_cast<std::size_t>(next - nodes.begin()),
            moment.Translation(row + static_cast<std::size_t>(*next - run.first)));
    }
    row += static_cast<std::size_t>(run.count);
  }
}

// Sums over the nodes that are in view now and belong to a moment: their positions then (p) and now
// (q).
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

// Computes the best rigid motion from the sums (Kabsch).
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
  // Few nodes, or nodes on a line, do not determine a rotation.
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
  const std::vector<int> nodes = ByNumber(observed.nodes());
  std::vector<Eigen::Vector3d> now;
  now.reserve(nodes.size());
  for (const int node : nodes) {
    anchored_.Add(node);
    now.push_back(map.NodePosition(node));
  }
  alignments_.clear();
  for (const Moment& moment : moments_) {
    Comparison comparison;
    VisitCommon(moment, nodes, [&](std::size_t k, const Eigen::Vector3d& translation) {
      comparison.Add(PlaceOf(map, nodes[k], translation), now[k]);
    });
    alignments_.push_back(Align(comparison));
  }
  JudgeLikeness();
}

// Rates each moment with a Gaussian of its difference. The width is at least `likeness`, and larger
// if even the nearest moment differs by more.
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

void TissueMemory::UpdatePriors(const std::vector<int>& nodes, DeformableMap* map) {
  std::vector<int> wanted;
  for (const int node : nodes) {
    if (!anchored_.Has(node)) wanted.push_back(node);
  }
  std::sort(wanted.begin(), wanted.end());
  std::vector<Eigen::Vector3d> sums(wanted.size(), Eigen::Vector3d::Zero());
  std::vector<double> totals(wanted.size(), 0.0);
  for (std::size_t m = 0; m < alignments_.size(); ++m) {
    const Alignment& now_from_then = alignments_[m];
    VisitCommon(moments_[m], wanted, [&](std::size_t k, const Eigen::Vector3d& translation) {
      sums[k] +=
          now_from_then.likeness * (now_from_then.rotation * PlaceOf(*map, wanted[k], translation) +
                                    now_from_then.translation);
      totals[k] += now_from_then.likeness;
    });
  }
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const int node = wanted[k];
    if (totals[k] > 0.0) {
      map->SetNodePrior(node, sums[k] / totals[k] - map->graph().position(node));
    } else {
      map->SetNodePrior(node, NodeTranslation(map->state().node(node)));
      anchored_.Add(node);
    }
  }
}

std::vector<int> TissueMemory::Affected() const {
  std::vector<Run> runs;
  for (std::size_t m = 0; m < alignments_.size(); ++m) {
    if (alignments_[m].common == 0) continue;
    runs.insert(runs.end(), moments_[m].runs.begin(), moments_[m].runs.end());
  }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.first < b.first; });
  std::vector<int> affected;
  int next = 0;
  for (const Run& run : runs) {
    for (next = std::max(next, run.first); next < run.first + run.count; ++next) {
      if (!anchored_.Has(next)) affected.push_back(next);
    }
  }
  return affected;
}

void TissueMemory::Keep(const NodeSet& observed, const DeformableMap& map) {
  const int moment = next_moment_++;
  if (moment % stride_ != 0) return;
  moments_.push_back(MakeMoment(ByNumber(observed.nodes()), map));
  if (static_cast<int>(moments_.size()) > options_.max_moments) Thin();
}

// Removes every second moment when their number has exceeded the limit.
void TissueMemory::Thin() {
  stride_ *= 2;
  std::size_t kept = 0;
  for (std::size_t m = 0; m < moments_.size(); m += 2) {
    if (m > 0) moments_[kept] = std::move(moments_[m]);
    ++kept;
  }
  moments_.resize(kept);
  alignments_.clear();
}

std::size_t TissueMemory::HeapBytes() const {
  std::size_t bytes = HeapBytesOf(moments_) + anchored_.HeapBytes() + HeapBytesOf(alignments_);
  for (const Moment& moment : moments_) {
    bytes += HeapBytesOf(moment.runs) + HeapBytesOf(moment.translations);
  }
  return bytes;
}

}  // namespace ceres_ed
