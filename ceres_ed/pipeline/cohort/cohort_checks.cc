#include "ceres_ed/pipeline/cohort/cohort_checks.h"

namespace ceres_ed {

Status CheckCohort(const CohortSettings& settings) {
  const int inputs = (settings.manifest.empty() ? 0 : 1) + (settings.pairs.empty() ? 0 : 1) +
                     (settings.sequences.empty() ? 0 : 1);
  if (inputs != 1) {
    return Status::Error("--manifest, --pairs and --sequences: " + std::to_string(inputs) +
                         " of them are given, expected one");
  }
  const bool is_of_shapes = !settings.manifest.empty();
  if (is_of_shapes != !settings.source.empty()) {
    return Status::Error(is_of_shapes ? "no TEMPLATE is given, expected one for --manifest"
                                      : "TEMPLATE is '" + settings.source +
                                            "', expected none with --pairs or --sequences");
  }
  if (settings.iterate > 0 && !is_of_shapes) {
    return Status::Error("--iterate=" + std::to_string(settings.iterate) +
                         ", expected 0 with --pairs or --sequences");
  }
  if (settings.iterate > 0 && !settings.shard.IsWhole()) {
    return Status::Error("--iterate=" + std::to_string(settings.iterate) +
                         " with --shard, expected one of them: the mean needs all shapes");
  }
  return Status::Ok();
}

Status CheckMembers(const CohortSettings& settings,
                    const std::string& table,
                    const Manifest& manifest) {
  for (const CohortMember& member : manifest.members) {
    const std::string place =
        table + ": row " + std::to_string(member.row + 1) + ", " + member.name + ": ";
    if (manifest.kind == CohortKind::kShapes && !member.landmarks.empty() &&
        settings.fit.source_landmarks.empty()) {
      return Status::Error(place +
                           "has landmarks, expected --source_landmarks with those of TEMPLATE");
    }
    if (!member.unit.empty() && settings.unit.empty()) {
      return Status::Error(place + "has the unit " + member.unit +
                           ", expected --unit with that of TEMPLATE");
    }
  }
  return Status::Ok();
}

}  // namespace ceres_ed
