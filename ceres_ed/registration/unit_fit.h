// The data that all steps of a fit share.
#ifndef CERES_ED_REGISTRATION_UNIT_FIT_H_
#define CERES_ED_REGISTRATION_UNIT_FIT_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/util/timer.h>

#include <vector>

namespace ceres_ed {

// The surfaces, options and constraints of a fit, all in the unit frame. The pointers must outlive
// the fit.
struct UnitFit {
  const Surface* source = nullptr;
  // The target; null if there are only landmarks.
  const Surface* target = nullptr;
  const FitOptions* options = nullptr;
  const EnergyRegistry* registry = nullptr;
  std::vector<Correspondence> landmarks;
  std::vector<Correspondence> fixed;
  // The standard deviation of the noise of `target`.
  double noise = 0.0;
  // A timer that was started with the fit.
  const Timer* clock = nullptr;
  // The rigid motion that takes the source from its placement back to the given pose, without a
  // change of size; the identity if nothing was placed.
  Similarity given_from_placed;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_UNIT_FIT_H_
