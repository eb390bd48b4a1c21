// Energies as users write them: `point_to_plane:weight=2,loss=huber,loss_width=0.01;rotation`.
#ifndef CERES_ED_ENERGY_ENERGY_SPEC_H_
#define CERES_ED_ENERGY_ENERGY_SPEC_H_

#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <ceres/loss_function.h>

namespace ceres_ed {

enum class LossType { kSquared, kHuber, kCauchy, kTukey, kWelsch, kGemanMcClure };

constexpr std::array<NamedValue<LossType>, 6> NamesOf(LossType) {
  return {{{"squared", LossType::kSquared},
           {"huber", LossType::kHuber},
           {"cauchy", LossType::kCauchy},
           {"tukey", LossType::kTukey},
           {"welsch", LossType::kWelsch},
           {"geman_mcclure", LossType::kGemanMcClure}}};
}

// A robust loss and the residual, in the residual's unit, at which it begins to give way.
struct LossSpec {
  LossType type = LossType::kSquared;
  // > 0; has no meaning for kSquared.
  double width = 0.01;
};

// Error: unknown name; lists the known ones.
StatusOr<LossType> ParseLossType(const std::string& name);

// Null for kSquared, as Ceres has it.
std::unique_ptr<ceres::LossFunction> MakeLoss(const LossSpec& spec);

// One energy to add to a problem. `parameters` are the energy's own.
struct EnergySpec {
  std::string name;
  // >= 0, no unit.
  double weight = 1.0;
  LossSpec loss;
  std::map<std::string, double> parameters;
};

// Parses NAME[:param=value,...] with several energies apart by `;`. Error: names the piece that
// can't be read and what was expected. Whether energy and parameters are known is the registry's
// question.
StatusOr<std::vector<EnergySpec>> ParseEnergySpecs(const std::string& text);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_ENERGY_SPEC_H_
