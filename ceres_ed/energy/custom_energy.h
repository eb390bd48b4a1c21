// Includes everything that is needed to write an energy of your own. There are four ways,
// depending on what the functor sees:
//
//   a warped point      ForEachPoint, ForEachMatch, ForEachDetailedMatch, ForEachLandmark
//                         (point_energy.h)
//   one or two nodes    ForEachNode, ForEachEdge (block_energy.h)
//   all warped points   ForAllPoints, one call a step (batch_energy.h)
//   anything else       MakeEnergy with AddPointResidual, AddPointsResidual, AddBlockResidual
//
// Each returns an EnergyTerm for EnergyRegistry::Register(). Weights, losses, constant blocks, PR
// and PI nodes, the solvers and all strategies then work without further code.
#ifndef CERES_ED_ENERGY_CUSTOM_ENERGY_H_
#define CERES_ED_ENERGY_CUSTOM_ENERGY_H_

#include <ceres_ed/energy/batch_energy.h>
#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/point_energy.h>

#endif  // CERES_ED_ENERGY_CUSTOM_ENERGY_H_
