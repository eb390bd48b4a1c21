// Writes what there is to look at of a run: a page, a picture.
#ifndef CERES_ED_PIPELINE_LOOK_H_
#define CERES_ED_PIPELINE_LOOK_H_

#include <ceres_ed/report/html/comparison_page.h>
#include <ceres_ed/report/html/sequence_comparison_page.h>
#include <ceres_ed/report/html/sequence_page.h>
#include <ceres_ed/report/picture/theme.h>
#include <ceres_ed/report/view/fit_view.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Where to; an empty path is not written.
struct LookOutputs {
  std::string html;
  std::string png;
  Theme theme = Theme::kLight;

  bool empty() const { return html.empty() && png.empty(); }
};

// Returns an error if an output is requested that this build can not make.
Status CheckLookOutputs(const LookOutputs& outputs);

// Does the same, and makes sure that the folders of the outputs are there (PrepareOutput()).
Status PrepareLook(const LookOutputs& outputs);

// Writes page and picture of a fit, or of the evaluation of one. `report` is what report.json has
// of it. Each file is written atomically. The error names the path.
Status WriteFitLook(const LookOutputs& outputs,
                    const nlohmann::ordered_json& report,
                    const FitView& view);

// Returns the same picture of a fit as a PNG file of `width` pixels; empty if this build can draw
// none, or if there is nothing to draw.
std::string FitPng(const nlohmann::ordered_json& report,
                   const FitView& view,
                   Theme theme,
                   int width);

// Writes page and picture of several runs beside each other.
Status WriteComparison(const LookOutputs& outputs, const std::vector<ComparedRun>& runs);

// Writes page and picture of the tracking of a sequence. `evaluation` is the report of ed_eval on
// it, or null.
Status WriteSequenceLook(const LookOutputs& outputs,
                         const nlohmann::ordered_json& report,
                         const nlohmann::ordered_json& evaluation,
                         const SequenceView& view);

// Writes page and picture of the tracking of several sequences, or of one in several ways.
Status WriteSequenceComparison(const LookOutputs& outputs,
                               const std::vector<ComparedSequence>& runs);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_LOOK_H_
