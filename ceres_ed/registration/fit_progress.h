// How much of a fit is done in each of its stages.
#ifndef CERES_ED_REGISTRATION_FIT_PROGRESS_H_
#define CERES_ED_REGISTRATION_FIT_PROGRESS_H_

#include <string_view>

namespace ceres_ed {

// The stages in their order, with the part of the time of a usual fit that has passed when they
// begin and end.
struct FitStage {
  std::string_view name;
  double begin;
  double end;
};

inline constexpr FitStage kFitStages[] = {{"rigid", 0.0, 0.1},
                                          {"graph", 0.1, 0.12},
                                          {"fit", 0.12, 0.8},
                                          {"finish", 0.8, 0.97},
                                          {"unfold", 0.97, 1.0}};

// Returns the part of the whole fit that is done, in [0, 1], when `part` in [0, 1] of the stage of
// this name is.
constexpr double PartOfFit(std::string_view stage, double part) {
  for (const FitStage& s : kFitStages) {
    if (s.name == stage) return s.begin + part * (s.end - s.begin);
  }
  return 0.0;
}

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_PROGRESS_H_
