#include "ceres_ed/evaluation/sequence_figures.h"

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

}  // namespace ceres_ed
