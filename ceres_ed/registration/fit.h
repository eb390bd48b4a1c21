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
class Surface;

// Fits `input`. Error: an input that can't be used, an unknown energy, bad options; the sentence
// says what was expected. A solve that fails is a result with status kFailed.
//
// The gauge: there is no camera in a fit. The rigid part is found first and held; what the nodes do
// is relative to it. Parts that nothing observes follow E_rot and E_reg.
StatusOr<FitResult> Fit(const FitInput& input,
                        const FitOptions& options,
                        const EnergyRegistry& registry);

// The same of two clouds alone, with default options and the built-in energies.
StatusOr<FitResult> Fit(const PointCloud& source, const PointCloud& target);

// Fits one source again and again: to the frames of a recording, to the shapes of a population.
// What depends on the source alone (normals, connectivity, what closest points are searched in) is
// made once. Results are those of Fit(), to the bit.
class SurfaceFitter {
 public:
  // `registry` must outlive it. Error: a source that can't be fitted, bad options.
  static StatusOr<std::unique_ptr<SurfaceFitter>> Create(PointCloud source,
                                                         const FitOptions& options,
                                                         const EnergyRegistry& registry);

  ~SurfaceFitter();
  SurfaceFitter(const SurfaceFitter&) = delete;
  SurfaceFitter& operator=(const SurfaceFitter&) = delete;

  const PointCloud& source() const { return source_; }

  // Fits the source to `target`; landmarks and fixed points are those of FitInput. From several
  // threads at once, too: nothing is shared that changes.
  StatusOr<FitResult> Fit(const PointCloud& target,
                          const std::vector<PointConstraint>& landmarks = {},
                          const std::vector<int>& fixed_points = {}) const;

 private:
  SurfaceFitter(PointCloud source, const FitOptions& options, const EnergyRegistry& registry);

  PointCloud source_;
  FitOptions options_;
  const EnergyRegistry& registry_;
  std::unique_ptr<const Surface> surface_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_H_
