// What the checks before a fit find.
#ifndef CERES_ED_PREFLIGHT_FINDING_H_
#define CERES_ED_PREFLIGHT_FINDING_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/util/named_values.h>

#include <array>
#include <string>
#include <vector>

namespace ceres_ed {

// A note is about something that a fit copes with by itself; a warning may spoil the result.
enum class Severity { kNote, kWarning };

constexpr std::array<NamedValue<Severity>, 2> NamesOf(Severity) {
  return {{{"note", Severity::kNote}, {"warning", Severity::kWarning}}};
}

// One fault of an input.
struct Finding {
  // A word for programs, in snake_case.
  std::string code;
  Severity severity = Severity::kWarning;
  // A sentence that names the file, what is wrong, and how much of it.
  std::string text;
  // What to do about it.
  std::string fix;
  // The figure by which it was found, for example a number of faces or a ratio.
  double value = 0.0;
};

// One cloud, as the checks see it.
struct Specimen {
  // The noun of the findings, for example the path of a file.
  std::string name;
  const PointCloud* cloud = nullptr;
  // The topology of `cloud`.
  const SurfaceTopology* topology = nullptr;
  // Whether the file stores positions as floats.
  bool has_float_positions = false;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PREFLIGHT_FINDING_H_
