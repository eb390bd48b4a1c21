// The settings of a fit of files.
#ifndef CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_
#define CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_

#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/report/picture/theme.h>
#include <ceres_ed/util/named_values.h>

#include <array>
#include <string>

namespace ceres_ed {

// From which verdict on a run ends as a failure, with its outputs written.
enum class FailIf { kNever, kDoubtful, kBad };

constexpr std::array<NamedValue<FailIf>, 3> NamesOf(FailIf) {
  return {{{"never", FailIf::kNever}, {"doubtful", FailIf::kDoubtful}, {"bad", FailIf::kBad}}};
}

// What becomes of landmarks that are named on both surfaces: they draw the fit, or only measure it.
enum class LandmarkUse { kFit, kMeasure };

constexpr std::array<NamedValue<LandmarkUse>, 2> NamesOf(LandmarkUse) {
  return {{{"fit", LandmarkUse::kFit}, {"measure", LandmarkUse::kMeasure}}};
}

// The anatomical space of the meshes, into which landmarks are turned (landmark_file.h). `auto`:
// what their files say, otherwise LPS.
enum class MeshSpace { kAuto, kLps, kRas };

constexpr std::array<NamedValue<MeshSpace>, 3> NamesOf(MeshSpace) {
  return {{{"auto", MeshSpace::kAuto}, {"LPS", MeshSpace::kLps}, {"RAS", MeshSpace::kRas}}};
}

// A path is empty if the file is not given or not requested.
struct FitSettings {
  FitOptions options;
  // The inputs. There must be a target, or landmarks, or both.
  std::string source;
  std::string target;
  std::string landmarks;
  // Landmarks by name; both or none (named_landmarks.h).
  std::string source_landmarks;
  std::string target_landmarks;
  LandmarkUse landmark_use = LandmarkUse::kFit;
  MeshSpace mesh_space = MeshSpace::kAuto;
  std::string fixed;
  // The unit of the source against that of the target (scale_setting.h).
  std::string scale;
  // Whether faults of the inputs are mended (preflight/repair.h).
  bool repair = false;
  // Shared objects with more energies, separated by ";".
  std::string plugin;
  // The outputs.
  std::string output;
  std::string warp;
  std::string graph;
  std::string report;
  std::string covariance;
  std::string html;
  std::string png;
  Theme theme = Theme::kLight;
  FailIf fail_if = FailIf::kNever;
  // The flags of the program, for the report.
  RunFlags flags;

  // Whether a page or a picture is requested.
  bool IsLookedAt() const { return !html.empty() || !png.empty(); }
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_
