#include "ceres_ed/slam/tissue_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// Weight of a moment that isn't like the present at all: what is left is the mean.
constexpr double kLeastLikeness = 1e-6;

// How a moment compares with the present.
struct Comparison {
  int common = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0.0;
};

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
  std::vector<Eigen::Vector3d> recalled(num_nodes);
  // By moment / stride.
  std::vector<Comparison> comparisons(next_moment_ / stride_ + 1);
  for (int j = 0; j < num_nodes; ++j) {
    recalled[j] = NodeTranslation(map.state().node(j));
    const bool seen = j < static_cast<int>(observed.size()) && observed[j] != 0;
    if (!seen || j >= static_cast<int>(traces_.size())) continue;
    for (const Trace& trace : traces_[j]) {
      Comparison& c = comparisons[trace.moment / stride_];
      const Eigen::Vector3d difference = recalled[j] - trace.translation;
      ++c.common;
      c.sum += difference;
      c.squares += difference.squaredNorm();
    }
  }
  // Likeness and common translation of each moment.
  std::vector<double> likeness(comparisons.size(), kLeastLikeness);
  double nearest = std::numeric_limits<double>::infinity();
  for (Comparison& c : comparisons) {
    if (c.common == 0) continue;
    c.sum /= c.common;
    c.squares = std::max(0.0, c.squares / c.common - c.sum.squaredNorm());
    if (c.common >= options_.min_common) nearest = std::min(nearest, c.squares);
  }
  const double width = std::max(nearest, options_.likeness * options_.likeness);
  for (std::size_t k = 0; k < comparisons.size(); ++k) {
    const Comparison& c = comparisons[k];
    if (c.common == 0 || !std::isfinite(width)) continue;
    const double share = std::min(1.0, c.common / static_cast<double>(options_.min_common));
    likeness[k] += share * std::exp(-0.5 * c.squares / width);
  }
  for (int j = 0; j < static_cast<int>(traces_.size()); ++j) {
    const bool seen = j < static_cast<int>(observed.size()) && observed[j] != 0;
    if (seen || traces_[j].empty()) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total = 0.0;
    for (const Trace& trace : traces_[j]) {
      const int k = trace.moment / stride_;
      sum += likeness[k] * (trace.translation + comparisons[k].sum);
      total += likeness[k];
    }
    recalled[j] = sum / total;
  }
  return recalled;
}

}  // namespace ceres_ed
