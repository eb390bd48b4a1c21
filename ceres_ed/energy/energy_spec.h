// Energies as users write them, for example
// `point_to_plane:weight=2,loss=huber,loss_width=0.01;rotation`.
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

// The robust losses.
enum class LossType { kSquared, kHuber, kCauchy, kTukey, kWelsch, kGemanMcClure };

constexpr std::array<NamedValue<LossType>, 6> NamesOf(LossType) {
  return {{{"squared", LossType::kSquared},
           {"huber", LossType::kHuber},
           {"cauchy", LossType::kCauchy},
           {"tukey", LossType::kTukey},
           {"welsch", LossType::kWelsch},
           {"geman_mcclure", LossType::kGemanMcClure}}};
}

// A robust loss and its width: the size of a residual, in its unit, from which on the loss reduces
// its influence.
struct LossSpec {
  LossType type = LossType::kSquared;
  // The width, > 0. It is not used for kSquared.
  double width = 0.01;
};

// Returns the loss of a name: squared, huber, cauchy, tukey, welsch or geman_mcclure. The error for
// any other name lists these.
StatusOr<LossType> ParseLossType(const std::string& name);

// Returns a new loss function; null for kSquared, as Ceres expects it. Fails a CHECK if the width
// is not > 0.
std::unique_ptr<ceres::LossFunction> MakeLoss(const LossSpec& spec);

// One energy of a problem. `parameters` are the parameters of its own.
struct EnergySpec {
  std::string name;
  // The weight, >= 0, without a unit.
  double weight = 1.0;
  LossSpec loss;
  std::map<std::string, double> parameters;
};

// Parses a list of NAME[:param=value,...] separated by `;`. The error names the piece that can't be
// read and what was expected. The function does not check whether energies and parameters exist;
// the registry does.
StatusOr<std::vector<EnergySpec>> ParseEnergySpecs(const std::string& text);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_ENERGY_SPEC_H_
