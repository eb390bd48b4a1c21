#include "ceres_ed/energy/energy_listing.h"

#include <sstream>

namespace ceres_ed {
namespace {

const char* TypeName(ParameterType type) {
  switch (type) {
    case ParameterType::kReal:
      return "number";
    case ParameterType::kInteger:
      return "integer";
    case ParameterType::kFlag:
      return "flag";
  }
  return "";
}

const char* KindName(EnergyKind kind) {
  return kind == EnergyKind::kObservation ? "observation" : "prior";
}

}  // namespace

std::string ListEnergies(const EnergyRegistry& registry) {
  std::ostringstream text;
  for (const EnergyInfo* energy : registry.List()) {
    text << energy->name << " (" << KindName(energy->kind) << ")\n  " << energy->summary
         << "\n  residual: " << energy->equation << ", unit: " << energy->unit << "\n";
    if (!energy->origin.empty()) text << "  from " << energy->origin << "\n";
    for (const EnergyParameter& parameter : energy->parameters) {
      text << "  " << parameter.name << ": " << TypeName(parameter.type)
           << ", unit: " << parameter.unit << ", range: " << parameter.minimum << " to "
           << parameter.maximum << ", default: " << parameter.default_value << "; " << parameter.doc
           << "\n";
    }
    text << "\n";
  }
  return text.str();
}

std::string ListEnergiesAsMarkdown(const EnergyRegistry& registry) {
  std::ostringstream text;
  for (const EnergyInfo* energy : registry.List()) {
    text << "### `" << energy->name << "`\n\n"
         << (energy->kind == EnergyKind::kObservation ? "Observation: " : "Prior: ")
         << energy->summary << ".\n\n    r = " << energy->equation
         << "\n\nUnit of r: " << energy->unit << ".\n\n";
    if (energy->parameters.empty()) continue;
    text << "| parameter | type | unit | range | default | |\n|---|---|---|---|--:|---|\n";
    for (const EnergyParameter& parameter : energy->parameters) {
      text << "| `" << parameter.name << "` | " << TypeName(parameter.type) << " | "
           << parameter.unit << " | " << parameter.minimum << " to " << parameter.maximum << " | "
           << parameter.default_value << " | " << parameter.doc << " |\n";
    }
    text << "\n";
  }
  return text.str();
}

}  // namespace ceres_ed
