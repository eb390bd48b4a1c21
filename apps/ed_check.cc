// ed_check looks at the inputs of a fit, and names each fault with its fix.
#include <ceres_ed/pipeline/check/check_run.h>
#include <ceres_ed/util/options.h>

#include <cstdio>
#include <string>
#include <vector>

#include <apps/support/console.h>
#include <apps/support/option_flags.h>
#include <apps/support/program.h>

namespace ceres_ed {
namespace {

struct CheckFlags {
  bool json = false;
};

const OptionTable<CheckFlags>& CheckRows() {
  using S = CheckFlags;
  static const OptionTable<S> rows({
      Row(&S::json, "json", "Print JSON instead of sentences.").Main(),
  });
  return rows;
}

const OptionFlags<CheckFlags> kFlags(CheckRows());

class CheckConsole : public ConsoleObserver<CheckObserver> {
 public:
  CheckConsole(const CheckSettings& settings, bool json)
      : ConsoleObserver("ed_check", /*quiet=*/false), settings_(settings), json_(json) {}

  void OnFindings(const std::vector<Finding>& findings) override {
    if (json_) {
      console().Summarize(CheckReport(settings_, findings)
                              .dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
                          "\n");
      return;
    }
    std::string lines;
    for (const Finding& finding : findings) {
      lines += NameOf(finding.severity) + ": " + finding.text + "; " + finding.fix + "\n";
    }
    console().Summarize(lines.empty() ? "no fault was found\n" : lines);
  }

 private:
  const CheckSettings& settings_;
  bool json_;
};

Outcome Run(const std::vector<std::string>& arguments) {
  const StatusOr<CheckFlags> flags = kFlags.Read();
  if (!flags.ok()) return Outcome::Usage(flags.status().message());
  CheckSettings settings;
  settings.source = arguments[0];
  if (arguments.size() > 1) settings.target = arguments[1];
  CheckConsole console(settings, flags->json);
  return RunCheck(settings, &console);
}

const ProgramInfo kProgram = {
    "ed_check",
    "SOURCE [TARGET]",
    "Looks at the inputs of a fit (units, winding, normals, faces, stray vertices, overlap and "
    "more), and names each fault with its fix. A note is about something that ed_fit copes with; a "
    "warning may spoil the result. Nothing is written.",
    "ed_check source.ply target.ply",
    1,
    2};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
