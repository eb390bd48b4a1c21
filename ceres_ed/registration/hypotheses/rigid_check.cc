#include "ceres_ed/registration/hypotheses/rigid_check.h"

#include <ceres_ed/registration/hypotheses/explanation.h>

#include <algorithm>
#include <sstream>

namespace ceres_ed {
namespace {

// The distance at which a point counts half as unmatched, as a fraction of the source's diagonal.
// Both states may be near the target, so it is small, but not below a multiple of the noise.
constexpr double kCheckWidth = 0.005;
constexpr double kCheckWidthPerNoise = 3.0;
// Shares that differ by less than this are equal: rounding and the meshing decide about the rest.
constexpr double kSameShare = 1e-4;
// A deformation with energies of the user may leave this times as much unexplained as the rigid
// placement, and this share more.
constexpr double kOwnEnergyFactor = 1.1;
constexpr double kOwnEnergyMargin = 0.02;

}  // namespace

std::string WhyRigidIsBetter(const UnitFit& fit,
                             const BuiltGraph& graph,
                             const DeformationState& state) {
  if (fit.target == nullptr || !fit.landmarks.empty() || !fit.fixed.empty()) return "";
  const double width = std::max(kCheckWidth, kCheckWidthPerNoise * fit.noise);
  const auto measure = [&](const DeformationState& measured) {
    return MeasureExplanation(fit, graph, measured, width).AgainstRigid();
  };
  const double rigid = measure(DeformationState(graph.graph.num_nodes()));
  const double fitted = measure(state);
  const bool has_own_energies = !fit.options->extra_energies.empty();
  const double most =
      has_own_energies ? kOwnEnergyFactor * rigid + kOwnEnergyMargin : rigid + kSameShare;
  if (fitted <= most) return "";
  std::ostringstream message;
  message << "the deformation leaves more of the surfaces unexplained (" << 100.0 * fitted
          << " %) than the rigid placement (" << 100.0 * rigid
          << " %): the result is the rigid one; are these two states of one body?";
  return message.str();
}

}  // namespace ceres_ed
