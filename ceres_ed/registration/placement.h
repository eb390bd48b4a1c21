// The first stage of a fit: both surfaces with a consistent orientation, and the rigid placement.
#ifndef CERES_ED_REGISTRATION_PLACEMENT_H_
#define CERES_ED_REGISTRATION_PLACEMENT_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/prepared_surface.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// Both surfaces of a fit in their given frames, and the rigid placement of the source.
struct Placement {
  // The target; null if only landmarks are fitted, or if the fit was stopped before it was needed.
  std::unique_ptr<const Surface> target;
  Similarity target_from_source;
  // The pose from which the rigid stage started: that of the landmarks, or the given one.
  Similarity given;
  // How well the rigid stage is determined, as in FitEvidence; -1 without a rigid stage.
  double score = -1.0;
  double runner_up = -1.0;
  double curvature = -1.0;
  // A sentence for each contradiction of the target's orientation that was removed.
  std::vector<std::string> notes;
};

// Places the surface `source` of `input` on the target. The given orientation of the target is a
// guess: a closed target must enclose a volume of the same sign as a closed source; any other
// target is turned inside out if this explains the surfaces clearly better. Without a rigid stage
// (options.rigid_first is false, or there are fixed points) this is decided at the given pose.
// `should_stop` ends the placement with the best pose so far.
Placement PlaceSurfaces(const FitInput& input,
                        const Surface& source,
                        const FitOptions& options,
                        const std::function<bool()>& should_stop);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_PLACEMENT_H_
