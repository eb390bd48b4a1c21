// The flags of ed_apply.
#ifndef CERES_ED_APPS_APPLY_SETTINGS_H_
#define CERES_ED_APPS_APPLY_SETTINGS_H_

#include <ceres_ed/pipeline/apply/field_settings.h>
#include <ceres_ed/pipeline/fit/fit_settings.h>

#include <string>

namespace ceres_ed {

struct ApplySettings {
  std::string output;
  std::string source;
  MeshSpace mesh_space = MeshSpace::kAuto;
  std::string displacement;
  FieldSettings field;
};

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_APPLY_SETTINGS_H_
