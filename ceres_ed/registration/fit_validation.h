// Checks the input of a fit.
#ifndef CERES_ED_REGISTRATION_FIT_VALIDATION_H_
#define CERES_ED_REGISTRATION_FIT_VALIDATION_H_

#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/util/status.h>

namespace ceres_ed {

// Returns an error if the source has too few points or no extent.
Status ValidateSource(const PointCloud& source);

// Returns an error if options are out of range, if a cloud has too few points or no extent, if an
// index is invalid, or if the sizes of the surfaces differ too much.
Status ValidateFit(const FitInput& input, const FitOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_VALIDATION_H_
