#include "ceres_ed/pipeline/look.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/report/html/fit_page.h>
#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/picture/png.h>
#include <ceres_ed/report/picture/scene_picture.h>

namespace ceres_ed {
namespace {

// Pages have a picture of this width, for where they cannot show the view.
constexpr int kPageWidth = 1100;

// Returns the verdict with its first reason.
std::string VerdictLine(const nlohmann::ordered_json& report) {
  const std::string grade = TextOf(report, {"verdict", "grade"});
  if (grade.empty()) return "";
  const nlohmann::ordered_json& reasons = MemberOf(report, {"verdict", "reasons"});
  const std::string reason =
      reasons.is_array() && !reasons.empty() ? TextOf(reasons[0], {"text"}) : "";
  return "verdict: " + grade + (reason.empty() ? "" : ", " + reason);
}

Status WritePicture(const std::string& path, const Scene& scene, const PictureOptions& options) {
  const std::string bytes = EncodePng(DrawScene(scene, options));
  if (bytes.empty()) return Status::Error(path + ": there is nothing to draw");
  return WriteFileAtomically(path, bytes);
}

// Returns the picture that a page shows where it cannot show the view; empty without pictures.
std::string PictureOfPage(const Scene& scene, PictureOptions options) {
  options.theme = Theme::kLight;
  options.width = kPageWidth;
  options.title.clear();
  options.subtitle.clear();
  return HasPictures() ? EncodePng(DrawScene(scene, options)) : "";
}

// Returns the words above the picture of a fit.
PictureOptions OptionsOfFit(const nlohmann::ordered_json& report) {
  PictureOptions options;
  options.title = FitTitle(report);
  options.subtitle = VerdictLine(report);
  return options;
}

// Writes the picture of a scene, and the page that `page_with` returns for the picture that it has
// in place of the view.
template <typename PageWith>
Status WriteBoth(const LookOutputs& outputs,
                 const Scene& scene,
                 PictureOptions options,
                 const PageWith& page_with) {
  if (!outputs.png.empty()) {
    options.theme = outputs.theme;
    Status status = WritePicture(outputs.png, scene, options);
    if (!status.ok()) return status;
  }
  if (outputs.html.empty()) return Status::Ok();
  return WriteFileAtomically(outputs.html, page_with(PictureOfPage(scene, options)));
}

}  // namespace

Status CheckLookOutputs(const LookOutputs& outputs) {
  if (outputs.png.empty() || HasPictures()) return Status::Ok();
  return Status::Error(outputs.png + ": " + kNoPictures);
}

Status PrepareLook(const LookOutputs& outputs) {
  Status status = CheckLookOutputs(outputs);
  for (const std::string& path : {outputs.html, outputs.png}) {
    if (status.ok() && !path.empty()) status = PrepareOutput(path);
  }
  return status;
}

Status WriteFitLook(const LookOutputs& outputs,
                    const nlohmann::ordered_json& report,
                    const FitView& view) {
  return WriteBoth(outputs, view.scene, OptionsOfFit(report), [&](const std::string& picture) {
    return FitPage(report, view, picture);
  });
}

std::string FitPng(const nlohmann::ordered_json& report,
                   const FitView& view,
                   Theme theme,
                   int width) {
  if (!HasPictures()) return "";
  PictureOptions options = OptionsOfFit(report);
  options.theme = theme;
  options.width = width;
  return EncodePng(DrawScene(view.scene, options));
}

Status WriteComparison(const LookOutputs& outputs, const std::vector<ComparedRun>& runs) {
  const Scene scene = SceneOfRuns(runs);
  PictureOptions options;
  options.title = std::to_string(runs.size()) + " runs compared";
  return WriteBoth(outputs, scene, options, [&](const std::string& picture) {
    return ComparisonPage(runs, scene, picture);
  });
}

Status WriteSequenceLook(const LookOutputs& outputs,
                         const nlohmann::ordered_json& report,
                         const nlohmann::ordered_json& evaluation,
                         const SequenceView& view) {
  PictureOptions options;
  options.title = SequenceTitle(report);
  options.subtitle = VerdictLine(report);
  return WriteBoth(outputs, view.scene, options, [&](const std::string& picture) {
    return SequencePage(report, evaluation, view, picture);
  });
}

Status WriteSequenceComparison(const LookOutputs& outputs,
                               const std::vector<ComparedSequence>& runs) {
  const Scene scene = SceneOfSequences(runs);
  PictureOptions options;
  options.title = std::to_string(runs.size()) + " runs compared";
  return WriteBoth(outputs, scene, options, [&](const std::string& picture) {
    return SequenceComparisonPage(runs, scene, picture);
  });
}

}  // namespace ceres_ed
