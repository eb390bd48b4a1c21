#include "ceres_ed/registration/moving_samples.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/parallel.h>

namespace ceres_ed {

MovingSamples::MovingSamples(const Surface& source, const BuiltGraph& graph, int count)
    : source_(&source), graph_(&graph), samples_(SamplePoints(source, count)) {
  for (const int point : samples_) {
    points_.push_back(source.cloud().points[point]);
    normals_.push_back(source.cloud().normals[point]);
  }
}

double MovingSamples::Move(const DeformationState& state, int num_threads) {
  const int count = static_cast<int>(samples_.size());
  std::vector<double> motions(samples_.size());
  ParallelFor(num_threads, count, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const int point = samples_[i];
      const Binding binding = graph_->skinning[point];
      const Eigen::Vector3d moved =
          WarpPoint(graph_->graph, state, binding, source_->cloud().points[point]);
      motions[i] = (moved - points_[i]).norm();
      points_[i] = moved;
      normals_[i] = WarpNormal(state, binding, source_->cloud().normals[point]);
    }
  });
  double sum = 0.0;
  for (const double motion : motions) sum += motion;
  return count > 0 ? sum / count : 0.0;
}

}  // namespace ceres_ed
