// ed_list_energies: every energy with its parameters, units, ranges and defaults.
#include <ceres_ed/energy/builtin_energies.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/plugin/plugin_loader.h>

#include <cstdio>
#include <string>
#include <vector>

#include <apps/support/program.h>
#include <gflags/gflags.h>

DEFINE_string(plugin, "", "shared object whose energies are listed too");

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

void Print(const EnergyInfo& energy) {
  std::printf("%s (%s)\n  %s\n  residual: %s, unit: %s\n",
              energy.name.c_str(),
              energy.kind == EnergyKind::kObservation ? "observation" : "prior",
              energy.summary.c_str(),
              energy.equation.c_str(),
              energy.unit.c_str());
  for (const EnergyParameter& parameter : energy.parameters) {
    std::printf("  %s: %s, unit: %s, range: %g to %g, default: %g; %s\n",
                parameter.name.c_str(),
                TypeName(parameter.type),
                parameter.unit.c_str(),
                parameter.minimum,
                parameter.maximum,
                parameter.default_value,
                parameter.doc.c_str());
  }
  std::printf("\n");
}

Outcome Run(const std::vector<std::string>&) {
  EnergyRegistry registry;
  RegisterBuiltinEnergies(&registry);
  if (!FLAGS_plugin.empty()) {
    if (Status status = LoadPlugin(FLAGS_plugin, &registry); !status.ok()) {
      return Outcome::BadInput(status);
    }
  }
  for (const EnergyInfo* energy : registry.List()) Print(*energy);
  std::printf(
      "Every energy takes weight (>= 0, default 1), loss (squared, huber, cauchy, tukey, welsch,\n"
      "geman_mcclure; default squared) and loss_width (> 0, unit of the residual) too:\n"
      "  ed_fit ... --energy='rotation:weight=2;point_to_plane:loss=huber,loss_width=0.01'\n");
  return Outcome::Done();
}

const ProgramInfo kProgram = {
    "ed_list_energies",
    "[--plugin=LIB.so]",
    "Lists every energy that ed_fit knows, with what its residual is, and the parameters that "
    "--energy takes: type, unit, range and default.",
    "ed_list_energies --plugin=./my_energy.so",
    0,
    0};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
