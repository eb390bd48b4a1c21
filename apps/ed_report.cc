// ed_report shows finished runs: a page for a browser, a picture, several runs beside each other.
#include <ceres_ed/pipeline/report/report_run.h>
#include <ceres_ed/util/options.h>

#include <string>
#include <utility>
#include <vector>

#include <apps/support/console.h>
#include <apps/support/option_flags.h>
#include <apps/support/program.h>

namespace ceres_ed {
namespace {

const OptionTable<ReportSettings>& ReportRows() {
  using S = ReportSettings;
  static const OptionTable<S> rows({
      Row(&S::html,
          "html",
          "HTML to write: the page. Without a file name, and without --png: report.html.")
          .File()
          .Alone("report.html"),
      Row(&S::png, "png", "PNG to write: the views as a picture. Without a file name: report.png.")
          .File()
          .Alone("report.png"),
      Row(&S::truth,
          "truth",
          "PLY to read: the true positions of the points of SOURCE, in their order.")
          .File(),
      Row(&S::theme, "theme", "The ground of --png.").Main(),
      NotData(&S::runs),
  });
  return rows;
}

const OptionFlags<ReportSettings> kFlags(ReportRows());

Outcome Run(const std::vector<std::string>& arguments) {
  StatusOr<ReportSettings> settings = kFlags.Read();
  if (!settings.ok()) return Outcome::Usage(settings.status().message());
  settings->runs = arguments;
  if (settings->html.empty() && settings->png.empty()) settings->html = "report.html";
  ConsoleObserver<> console("ed_report", /*quiet=*/false);
  return RunReport(*settings, &console);
}

constexpr int kMaxRuns = 32;

const ProgramInfo kProgram = {
    "ed_report",
    "RUN [RUN ...] [--html=F.html] [--png=F.png]",
    "Shows finished runs. RUN is a report.json that ed_fit, ed_slam or ed_eval has written, or a "
    "folder with one; the files that it names are shown as far as they are there. Several runs "
    "are compared: figures, flags that differ, and results seen by one camera.",
    "ed_report fit.json --html=fit.html --png=fit.png",
    1,
    kMaxRuns};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
