// ed_list_energies lists every energy with its parameters, units, ranges and defaults.
#include <ceres_ed/energy/energy_listing.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/util/options.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <apps/support/option_flags.h>
#include <apps/support/program.h>

namespace ceres_ed {
namespace {

enum class ListFormat { kText, kMarkdown };

constexpr std::array<NamedValue<ListFormat>, 2> NamesOf(ListFormat) {
  return {{{"text", ListFormat::kText}, {"markdown", ListFormat::kMarkdown}}};
}

struct ListSettings {
  std::string plugin;
  ListFormat format = ListFormat::kText;
};

const OptionTable<ListSettings>& ListRows() {
  using S = ListSettings;
  static const OptionTable<S> rows({
      Row(&S::plugin,
          "plugin",
          "Shared object whose energies are listed, too, or several, separated by ';'.")
          .File(),
      Row(&S::format, "format", "How the energies are written.").Main(),
  });
  return rows;
}

const OptionFlags<ListSettings> kFlags(ListRows());

Outcome Run(const std::vector<std::string>&) {
  const StatusOr<ListSettings> settings = kFlags.Read();
  if (!settings.ok()) return Outcome::Usage(settings.status().message());
  EnergyRegistry registry;
  Outcome outcome = LoadEnergies(settings->plugin, {}, &registry);
  if (outcome.code != ExitCode::kDone) return outcome;
  if (settings->format == ListFormat::kMarkdown) {
    std::fputs(ListEnergiesAsMarkdown(registry).c_str(), stdout);
    return Outcome::Done();
  }
  std::fputs(ListEnergies(registry).c_str(), stdout);
  std::printf(
      "Every energy also takes weight (>= 0, default 1), loss (squared, huber, cauchy, tukey,\n"
      "welsch, geman_mcclure; default squared) and loss_width (> 0, unit of the residual):\n"
      "  ed_fit ... --energy='rotation:weight=2;point_to_plane:loss=huber,loss_width=0.01'\n");
  return Outcome::Done();
}

const ProgramInfo kProgram = {
    "ed_list_energies",
    "[--plugin=LIB.so]",
    "Lists every energy that ed_fit knows, with its residual and the parameters that --energy "
    "takes: type, unit, range and default.",
    "ed_list_energies --plugin=./my_energy.so",
    0,
    0};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
