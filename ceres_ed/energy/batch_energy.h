// Energies on all warped points at once: one call of a function a step, for functions that cost
// much to call, however few points they get (a function of Python, a neural network).
#ifndef CERES_ED_ENERGY_BATCH_ENERGY_H_
#define CERES_ED_ENERGY_BATCH_ENERGY_H_

#include <ceres_ed/energy/batch_store.h>
#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/point_energy.h>

#include <memory>

namespace ceres_ed {

// Returns an energy with the residuals of `function` on every point of the context.
std::unique_ptr<EnergyTerm> ForAllPoints(EnergyKind kind,
                                         const std::shared_ptr<const PointBatchFunction>& function,
                                         PointFrame frame = PointFrame::kObserved);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_BATCH_ENERGY_H_
