#include "apps/apply_field.h"

#include <ceres_ed/pipeline/apply/field_run.h>

#include <cstdarg>
#include <cstdio>

#include <apps/support/console.h>
#include <apps/support/program.h>

namespace ceres_ed {
namespace {

__attribute__((format(printf, 1, 2))) std::string Format(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  return text;
}

class FieldConsole : public ConsoleObserver<FieldObserver> {
 public:
  explicit FieldConsole(const FieldSettings& settings)
      : ConsoleObserver("ed_apply", /*quiet=*/false), settings_(settings) {}

  void OnGrid(const WrittenField& planned) override {
    const FieldGrid& grid = planned.grid;
    console().Summarize(
        settings_.field +
        Format(": %s field, %d x %d x %d points, spacing %.4g, %.3g MB before compression\n",
               settings_.inverse ? "inverse (TARGET to SOURCE)" : "forward (SOURCE to TARGET)",
               grid.size[0],
               grid.size[1],
               grid.size[2],
               planned.spacing,
               planned.megabytes) +
        "  axes: " +
        (planned.is_lps ? "LPS in mm; the surfaces are taken for " + AxesOfSurfaces()
                        : std::string("those of the surfaces")) +
        "\n");
  }

  void OnField(const WrittenField& written) override {
    if (settings_.inverse) console().Summarize(InverseText(written));
    console().Summarize(
        Format("  at %zu points of the surface the interpolated field is off by %.2g spacings in "
               "the mean, %.2g at most\n",
               written.error.num_points,
               written.error.mean,
               written.error.max));
  }

  void OnRigid(const std::string& sentence) override { console().Summarize(sentence + "\n"); }

 private:
  std::string AxesOfSurfaces() const {
    const bool is_lps = settings_.frame == SurfaceAxes::kLps;
    return std::string(is_lps ? "LPS" : "RAS") + " in " + NameOf(settings_.unit) +
           " (--frame, --unit)";
  }

  std::string InverseText(const WrittenField& written) const {
    const auto num_points = static_cast<double>(written.grid.num_points());
    const InverseQuality& inverse = written.inverse;
    return Format(
        "  the residual of the inverse is %.2g spacings in the mean, %.2g at most; the "
        "warp has no inverse at %.2g %% of the grid (%s there), and is folded at %.2g "
        "%%\n",
        inverse.mean_residual,
        inverse.max_residual,
        100.0 * static_cast<double>(inverse.num_without) / num_points,
        NameOf(settings_.no_inverse).c_str(),
        100.0 * static_cast<double>(inverse.num_folded) / num_points);
  }

  const FieldSettings& settings_;
};

}  // namespace

Outcome ApplyField(const FieldSettings& settings,
                   const std::string& warp_path,
                   const Warp& warp,
                   const PointCloud* cloud) {
  InstallStopHandler();
  FieldConsole console(settings);
  return RunField(settings, warp_path, warp, cloud, &console);
}

}  // namespace ceres_ed
