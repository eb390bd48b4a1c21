// What a fit accepts.
#ifndef CERES_ED_REGISTRATION_FIT_VALIDATION_H_
#define CERES_ED_REGISTRATION_FIT_VALIDATION_H_

#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/util/status.h>

namespace ceres_ed {

// Error: too few points, no extent.
Status ValidateSource(const PointCloud& source);

// Error: options out of range, too few points, no extent, indices that aren't there, surfaces that
// share no scale.
Status ValidateFit(const FitInput& input, const FitOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_VALIDATION_H_
