#include "ceres_ed/pipeline/cohort/member_fit.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/pipeline/fit/fit_picture.h>
#include <ceres_ed/pipeline/fit/scale_setting.h>
#include <ceres_ed/report/picture/png.h>
#include <ceres_ed/report/picture/scene_picture.h>

#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

// Returns a picture of the result, coloured by its distance to the shape.
std::string DrawThumbnail(const FitRun& run) {
  constexpr int kPoints = 6000;
  constexpr int kWidth = 320;
  FitParts parts = PartsOfFit(run.files->input, *run.result, run.files->vertex_of_point);
  parts.max_points = kPoints;
  Scene scene = MakeFitView(parts).scene;
  scene.panels = {{"", 0, 1.0, false, true}};
  scene.graph = {};
  scene.landmarks.clear();
  PictureOptions options;
  options.width = kWidth;
  return EncodePng(DrawScene(scene, options));
}

// Takes the figures of a fit, and writes what is not written by the fit itself.
class MemberObserver : public FitObserver {
 public:
  MemberObserver(const CohortContext& context,
                 const MemberFolder& folder,
                 double points_per_unit,
                 const std::function<bool()>& should_stop,
                 MemberRecord* record)
      : context_(context),
        folder_(folder),
        points_per_unit_(points_per_unit),
        should_stop_(should_stop),
        record_(*record) {}

  bool ShouldStop() override { return should_stop_(); }

  void OnEnd(const FitRun& run) override {
    TakeFigures(run);
    status_ = WritePoints(run);
    if (!status_.ok() || !context_.settings->pages || !HasPictures()) return;
    status_ = WriteFileAtomically(folder_.File("thumbnail.png"), DrawThumbnail(run));
  }

  const Status& status() const { return status_; }

 private:
  void TakeFigures(const FitRun& run) {
    record_.grade = run.verdict.grade;
    if (!run.verdict.reasons.empty()) record_.message = run.verdict.reasons.front().text;
    const FitEvidence& evidence = run.result->evidence;
    if (evidence.measured) {
      record_.unmatched_source = evidence.source.Unmatched();
      record_.unmatched_target = evidence.target.Unmatched();
      if (evidence.edge_stretch >= 0.0) record_.stretch = evidence.edge_stretch;
    }
    const std::vector<LandmarkError> named = MeasureNamedLandmarks(run);
    const LandmarkErrors errors =
        named.empty() ? MeasureLandmarks(run) : SummarizeLandmarks(named, &LandmarkError::after);
    record_.landmarks = errors.count;
    if (errors.count > 0) record_.landmark_rms = errors.rms;
  }

  Status WritePoints(const FitRun& run) {
    NpyArray array;
    array.shape = {run.result->points.size(), 3};
    array.values.reserve(3 * run.result->points.size());
    for (const Eigen::Vector3d& point : run.result->points) {
      for (int axis = 0; axis < 3; ++axis) array.values.push_back(point[axis] / points_per_unit_);
    }
    return WriteNpyFile(folder_.File("points.npy"), array);
  }

  const CohortContext& context_;
  const MemberFolder& folder_;
  const double points_per_unit_;
  const std::function<bool()>& should_stop_;
  MemberRecord& record_;
  Status status_ = Status::Ok();
};

RunFlag GivenText(const std::string& name, const std::string& value) {
  RunFlag flag;
  flag.name = name;
  flag.value = value;
  flag.is_given = true;
  return flag;
}

// Returns the settings of the fit, whose files are in `folder` until they are complete. The flags
// name the files as ed_fit would have to write them afterwards.
FitSettings SettingsOf(const CohortContext& context,
                       const CohortMember& member,
                       const MemberFolder& folder) {
  const CohortSettings& cohort = *context.settings;
  FitSettings fit = cohort.fit;
  fit.fail_if = FailIf::kNever;
  fit.options.num_threads = 1;
  fit.source = context.kind == CohortKind::kPairs ? member.source : cohort.source;
  fit.target = member.path;
  if (context.kind == CohortKind::kPairs) fit.source_landmarks = member.source_landmarks;
  fit.target_landmarks = member.landmarks;
  if (member.landmarks.empty()) fit.source_landmarks.clear();
  if (!member.unit.empty() && member.unit != cohort.unit) {
    fit.scale = cohort.unit + ":" + member.unit;
  }
  const std::string final_path = MemberPath(cohort.output, member.name);
  fit.flags = cohort.fit.flags;
  const auto write = [&](const char* flag, const char* file, std::string FitSettings::*path) {
    fit.*path = folder.File(file);
    fit.flags.push_back(GivenText(flag, final_path + "/" + file));
  };
  write("output", "fitted.ply", &FitSettings::output);
  write("report", "report.json", &FitSettings::report);
  if (cohort.warps) write("warp", "warp.json", &FitSettings::warp);
  if (cohort.pages) write("html", "report.html", &FitSettings::html);
  const auto name = [&fit](const char* flag, const std::string& value) {
    if (value.empty()) return;
    RunFlags& flags = fit.flags;
    for (RunFlag& known : flags) {
      if (known.name != flag) continue;
      known = GivenText(flag, value);
      return;
    }
    flags.push_back(GivenText(flag, value));
  };
  name("source_landmarks", fit.source_landmarks);
  name("target_landmarks", fit.target_landmarks);
  name("scale", fit.scale);
  return fit;
}

}  // namespace

Outcome FitMember(const CohortContext& context,
                  const CohortMember& member,
                  const MemberFolder& folder,
                  const std::function<bool()>& should_stop,
                  MemberRecord* record) {
  const FitSettings settings = SettingsOf(context, member, folder);
  double points_per_unit = 1.0;
  if (!member.unit.empty() && member.unit != context.settings->unit) {
    const StatusOr<ScaleSetting> scale = ParseScale(settings.scale);
    if (!scale.ok()) return Outcome::BadInput(scale.status());
    points_per_unit = scale->factor;
  }
  MemberObserver observer(context, folder, points_per_unit, should_stop, record);
  const Timer clock;
  const SharedSource shared = {context.registry, context.source, context.fitter};
  Outcome outcome = RunFit(settings, shared, clock, &observer);
  if (!observer.status().ok()) return Outcome::BadInput(observer.status());
  return outcome;
}

}  // namespace ceres_ed
