// Fits one surface to another, to landmarks, or to both.
#ifndef CERES_ED_REGISTRATION_FIT_H_
#define CERES_ED_REGISTRATION_FIT_H_
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <vector>

namespace ceres_ed {

class EnergyRegistry;
struct PreparedSurface;

// Fits `input` and returns the result. It is an error if the input cannot be used, an energy is
// unknown or an option is invalid; the message says what was expected. A solve that fails is not an
// error but a result with the status kFailed.
//
// The gauge: a fit has no camera. The rigid part is determined first and then held; the deformation
// of the nodes is relative to it. Parts that nothing observes follow E_rot and E_reg.
StatusOr<FitResult> Fit(const FitInput& input,
                        const FitOptions& options,
                        const EnergyRegistry& registry);

// Fits two clouds with default options and the built-in energies.
StatusOr<FitResult> Fit(const PointCloud& source, const PointCloud& target);

// Fits one source many times, for example to the frames of a recording or to the shapes of a
// population. Data that depend on the source only (normals, connectivity, search structures) are
// computed once. The results are those of Fit(), with the same bits.
class SurfaceFitter {
 public:
  // Returns a fitter of `source`. `registry` must outlive it. It is an error if the source cannot
  // be fitted or an option is invalid.
  static StatusOr<std::unique_ptr<SurfaceFitter>> Create(PointCloud source,
                                                         const FitOptions& options,
                                                         const EnergyRegistry& registry);

  ~SurfaceFitter();
  SurfaceFitter(const SurfaceFitter&) = delete;
  SurfaceFitter& operator=(const SurfaceFitter&) = delete;

  const PointCloud& source() const { return source_; }

  // Fits the source to `target`. Landmarks and fixed points have the meaning of FitInput. May be
  // called from several threads at once, because no shared data change.
  StatusOr<FitResult> Fit(const PointCloud& target,
                          const std::vector<Landmark>& landmarks = {},
                          const std::vector<int>& fixed_points = {}) const;

  // Does the same with other options than those of Create(). It is an error if one is invalid.
  StatusOr<FitResult> FitWith(const FitOptions& options,
                              const PointCloud& target,
                              const std::vector<Landmark>& landmarks = {},
                              const std::vector<int>& fixed_points = {}) const;

 private:
  SurfaceFitter(PointCloud source, const FitOptions& options, const EnergyRegistry& registry);

  PointCloud source_;
  FitOptions options_;
  const EnergyRegistry& registry_;
  std::unique_ptr<const PreparedSurface> prepared_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_H_
