#include "ceres_ed/energy/energy_spec.h"

#include <ceres_ed/util/shown_text.h>
#include <ceres_ed/util/text.h>

#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

#include <cost_functions/robust_loss.h>

namespace ceres_ed {
namespace {

Status SetParameter(const std::string& key, const std::string& value, EnergySpec* spec) {
  if (key == "loss") {
    StatusOr<LossType> type = ParseLossType(value);
    if (!type.ok()) return type.status();
    spec->loss.type = *type;
    return Status::Ok();
  }
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (value.empty() || *end != '\0' || !std::isfinite(number)) {
    return Status::Error("energy '" + spec->name + "': " + key + "='" + value +
                         "', expected a finite number");
  }
  if (key == "weight") {
    if (number < 0.0) {
      return Status::Error("energy '" + spec->name + "': weight=" + value + ", expected >= 0");
    }
    spec->weight = number;
  } else if (key == "loss_width") {
    if (number <= 0.0) {
      return Status::Error("energy '" + spec->name + "': loss_width=" + value + ", expected > 0");
    }
    spec->loss.width = number;
  } else {
    spec->parameters[key] = number;
  }
  return Status::Ok();
}

StatusOr<EnergySpec> ParseOne(const std::string& text) {
  EnergySpec spec;
  const std::size_t colon = text.find(':');
  spec.name = text.substr(0, colon);
  if (spec.name.empty()) {
    return Status::Error("energy '" + text + "': expected NAME[:param=value,...]");
  }
  if (colon == std::string::npos) return spec;
  bool has_width = false;
  for (const std::string_view setting : SplitLines(std::string_view(text).substr(colon + 1), ',')) {
    const std::string piece(setting);
    const std::size_t equals = piece.find('=');
    if (equals == std::string::npos || equals == 0) {
      return Status::Error("energy '" + spec.name + "': '" + piece + "', expected param=value");
    }
    const std::string key = piece.substr(0, equals);
    has_width = has_width || key == "loss_width";
    Status status = SetParameter(key, piece.substr(equals + 1), &spec);
    if (!status.ok()) return status;
  }
  if (has_width && spec.loss.type == LossType::kSquared) {
    return Status::Error("energy '" + spec.name +
                         "': loss_width has no use without a loss, expected loss=huber or another");
  }
  return spec;
}

}  // namespace

StatusOr<LossType> ParseLossType(const std::string& name) {
  const std::optional<LossType> type = FindByName<LossType>(name);
  if (type.has_value()) return *type;
  return Status::Error("loss '" + name + "', expected one of: " + ListNames<LossType>(", "));
}

std::unique_ptr<ceres::LossFunction> MakeLoss(const LossSpec& spec) {
  if (spec.type != LossType::kSquared) {
    CHECK(spec.width > 0.0) << "loss width " << spec.width;
  }
  switch (spec.type) {
    case LossType::kSquared:
      return nullptr;
    case LossType::kHuber:
      return std::make_unique<ceres::HuberLoss>(spec.width);
    case LossType::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(spec.width);
    case LossType::kTukey:
      return std::make_unique<ceres::TukeyLoss>(spec.width);
    case LossType::kWelsch:
      return std::make_unique<WelschLoss>(spec.width);
    case LossType::kGemanMcClure:
      return std::make_unique<GemanMcClureLoss>(spec.width);
  }
  LOG(FATAL) << "unnamed loss " << static_cast<int>(spec.type);
}

StatusOr<std::vector<EnergySpec>> ParseEnergySpecs(const std::string& text) {
  std::vector<EnergySpec> specs;
  for (const std::string_view piece : SplitLines(text, ';')) {
    if (piece.empty()) continue;
    StatusOr<EnergySpec> spec = ParseOne(std::string(piece));
    // The sentence repeats what was written, which may be anything.
    if (!spec.ok()) return Status::Error(ShownLine(spec.status().message()));
    specs.push_back(*std::move(spec));
  }
  return specs;
}

}  // namespace ceres_ed
