#include "ceres_ed/registration/evidence/way_agreement.h"

#include <ceres_ed/registration/moving_samples.h>

#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

constexpr int kSamples = 1000;

}  // namespace

void WayAgreement::Add(const Surface& source,
                       const BuiltGraph& graph,
                       const DeformationState& state,
                       double left) {
  MovingSamples samples(source, graph, kSamples);
  samples.Move(state, /*num_threads=*/1);
  End end = {left, *samples.Moved().points};
  if (best_.points.empty() || left < best_.left) std::swap(end, best_);
  if (!end.points.empty() && (second_.points.empty() || end.left < second_.left)) {
    second_ = std::move(end);
  }
}

double WayAgreement::Disagreement() const {
  if (second_.points.empty()) return -1.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < best_.points.size(); ++i) {
    sum += (best_.points[i] - second_.points[i]).norm();
  }
  return sum / static_cast<double>(best_.points.size());
}

}  // namespace ceres_ed
