// All that an energy of your own needs. Three ways in, by what its functor sees:
//
//   a warped point      ForEachPoint, ForEachMatch, ForEachDetailedMatch, ForEachLandmark
//                         (point_energy.h)
//   one or two nodes    ForEachNode, ForEachEdge (block_energy.h)
//   anything else       MakeEnergy with AddPointResidual, AddPointsResidual, AddBlockResidual
//
// Each gives an EnergyTerm for EnergyRegistry::Register. Weights, losses, held blocks, PR and PI
// nodes, the solvers and all strategies need no more of it.
#ifndef CERES_ED_ENERGY_CUSTOM_ENERGY_H_
#define CERES_ED_ENERGY_CUSTOM_ENERGY_H_

#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/point_energy.h>

#endif  // CERES_ED_ENERGY_CUSTOM_ENERGY_H_
