#include "ceres_ed/pipeline/check/check_run.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/check/check_files.h>
#include <ceres_ed/pipeline/intention.h>
#include <ceres_ed/version.h>

namespace ceres_ed {

Outcome RunCheck(const CheckSettings& settings, CheckObserver* observer) {
  const StatusOr<LoadedCloud> source = LoadSurface(settings.source);
  if (!source.ok()) return Outcome::BadInput(source.status());
  for (const std::string& warning : source->warnings) observer->OnWarning(warning);
  CheckedFile from = {settings.source, &source->cloud, &source->document};
  CheckedFile to;
  if (settings.target.empty()) {
    observer->OnFindings(CheckFiles(from, to));
    return Outcome::Done();
  }
  const StatusOr<LoadedCloud> target = LoadSurface(settings.target);
  if (!target.ok()) return Outcome::BadInput(target.status());
  for (const std::string& warning : target->warnings) observer->OnWarning(warning);
  to = {settings.target, &target->cloud, &target->document};
  observer->OnFindings(CheckFiles(from, to));
  return Outcome::Done();
}

nlohmann::ordered_json CheckReport(const CheckSettings& settings,
                                   const std::vector<Finding>& findings) {
  nlohmann::ordered_json report = {
      {"program", "ed_check"}, {"version", kVersion}, {"source", settings.source}};
  report["target"] = nullptr;
  if (!settings.target.empty()) report["target"] = settings.target;
  report["checks"] = ChecksReport(findings);
  return report;
}

}  // namespace ceres_ed
