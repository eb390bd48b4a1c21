#include "ceres_ed/evaluation/sequence_figures.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace ceres_ed {

AcrossFrames SummarizeTruth(const std::vector<FrameTruthError>& frames, const TruthFigure& figure) {
  std::vector<std::optional<double>> values;
  values.reserve(frames.size());
  for (const FrameTruthError& frame : frames) values.push_back(figure.Of(frame));
  return SummarizeFrames(values);
}

AcrossFrames SummarizeDepth(const std::vector<DepthAgreement>& frames,
                            double DistanceStatistics::*statistic) {
  std::vector<std::optional<double>> values;
  for (const DepthAgreement& frame : frames) {
    if (frame.residual) values.emplace_back(*frame.residual.*statistic);
  }
  return SummarizeFrames(values);
}

AcrossFrames SummarizeFarShare(const std::vector<DepthAgreement>& frames) {
  std::vector<std::optional<double>> values;
  values.reserve(frames.size());
  for (const DepthAgreement& frame : frames) values.push_back(frame.far_share);
  return SummarizeFrames(values);
}

EndPointError CompareEndPoints(int points_at_start,
                               const std::vector<Eigen::Vector2d>& predicted,
                               const std::vector<Eigen::Vector2d>& given) {
  EndPointError result;
  result.points = points_at_start;
  result.followed = static_cast<int>(predicted.size());
  std::vector<double> errors;
  for (const Eigen::Vector2d& pixel : predicted) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& point : given) nearest = std::min(nearest, (pixel - point).norm());
    errors.push_back(nearest);
  }
  if (errors.empty()) return result;
  for (std::size_t i = 0; i < kEndPointBounds.size(); ++i) {
    const auto count = std::count_if(
        errors.begin(), errors.end(), [i](double error) { return error <= kEndPointBounds[i]; });
    result.within[i] = static_cast<double>(count) / static_cast<double>(errors.size());
  }
  result.error = Summarize(errors);
  return result;
}

}  // namespace ceres_ed
