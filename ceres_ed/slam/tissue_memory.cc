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

// Sums over the nodes that are in view now and were at a moment: places then (p) and now (q).
struct Comparison {
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

// A moment laid on the present: q = rotation p + translation, as well as a rigid motion can.
struct Alignment {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  // Mean of |q - rotation p - translation|^2: how unlike they are.
  double difference = 0.0;
};

Alignment Align(const Comparison& c) {
  Alignment alignment;
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

}  // namespace

void TissueMemory::Keep(const DeformableMap& map, const std::vector<char>& observed) {
  const int moment = next_moment_++;
  if (moment % stride_ != 0) return;
  traces_.resize(map.graph().num_nodes());
  for (int j = 0; j < static_cast<int>(observed.size()); ++j) {
    if (observed[j] == 0) continue;
    traces_[j].push_back({moment, NodeTranslation(map.state().node(j))});
  }
  if (++kept_ > options_.max_moments) Thin();
}

void TissueMemory::Thin() {
  stride_ *= 2;
  kept_ = (next_moment_ - 1) / stride_ + 1;
  const auto goes = [this](const Trace& trace) { return trace.moment % stride_ != 0; };
  for (std::vector<Trace>& trace : traces_) {
    trace.erase(std::remove_if(trace.begin(), trace.end(), goes), trace.end());
  }
}

std::vector<Eigen::Vector3d> TissueMemory::Recall(const DeformableMap& map,
                                                  const std::vector<char>& observed) const {
  const int num_nodes = map.graph().num_nodes();
  const auto is_observed = [&observed](int j) {
    return j < static_cast<int>(observed.size()) && observed[j] != 0;
  };
  const auto place = [&map](int j, const Eigen::Vector3d& translation) -> Eigen::Vector3d {
    return map.graph().position(j) + translation;
  };
  std::vector<Eigen::Vector3d> recalled(num_nodes);
  // By moment / stride.
  std::vector<Comparison> comparisons(next_moment_ / stride_ + 1);
  for (int j = 0; j < num_nodes; ++j) {
    recalled[j] = NodeTranslation(map.state().node(j));
    if (!is_observed(j) || j >= static_cast<int>(traces_.size())) continue;
    for (const Trace& trace : traces_[j]) {
      comparisons[trace.moment / stride_].Add(place(j, trace.translation), place(j, recalled[j]));
    }
  }
  double width = options_.likeness * options_.likeness;
  std::vector<Alignment> alignments;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Comparison& c : comparisons) {
    alignments.push_back(Align(c));
    if (c.common >= options_.min_common) {
      nearest = std::min(nearest, alignments.back().difference);
    }
  }
  if (std::isfinite(nearest)) width = std::max(width, nearest);
  std::vector<double> likeness(comparisons.size(), kLeastLikeness);
  for (std::size_t k = 0; k < comparisons.size(); ++k) {
    if (comparisons[k].common == 0) continue;
    const double share =
        std::min(1.0, comparisons[k].common / static_cast<double>(options_.min_common));
    likeness[k] += share * std::exp(-0.5 * alignments[k].difference / width);
  }
  for (int j = 0; j < static_cast<int>(traces_.size()); ++j) {
    if (is_observed(j) || traces_[j].empty()) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total = 0.0;
    for (const Trace& trace : traces_[j]) {
      const Alignment& now_from_then = alignments[trace.moment / stride_];
      const double weight = likeness[trace.moment / stride_];
      sum += weight *
             (now_from_then.rotation * place(j, trace.translation) + now_from_then.translation);
      total += weight;
    }
    recalled[j] = sum / total - map.graph().position(j);
  }
  return recalled;
}

}  // namespace ceres_ed
