// The settings of a transform that is written for other tools.
#ifndef CERES_ED_PIPELINE_APPLY_FIELD_SETTINGS_H_
#define CERES_ED_PIPELINE_APPLY_FIELD_SETTINGS_H_

#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <optional>
#include <string>

#include <Eigen/Geometry>

namespace ceres_ed {

// The axes of the surfaces' coordinates: x to the left, y to the back and z to the head of the
// patient, or x to the right, y to the front and z to the head.
enum class SurfaceAxes { kLps, kRas };

constexpr std::array<NamedValue<SurfaceAxes>, 2> NamesOf(SurfaceAxes) {
  return {{{"lps", SurfaceAxes::kLps}, {"ras", SurfaceAxes::kRas}}};
}

// The unit of the surfaces' coordinates.
enum class SurfaceUnit { kMillimetres, kCentimetres, kMetres };

constexpr std::array<NamedValue<SurfaceUnit>, 3> NamesOf(SurfaceUnit) {
  return {{{"mm", SurfaceUnit::kMillimetres},
           {"cm", SurfaceUnit::kCentimetres},
           {"m", SurfaceUnit::kMetres}}};
}

// What an inverse field has at grid points that the warp does not reach.
enum class NoInverse {
  // Not a number. Tools of ITK then take the point for one outside the image.
  kNan,
  // The displacement zero.
  kZero,
  // The displacement to the point that the warp moves nearest, as far as the search has found it.
  kNearest,
};

constexpr std::array<NamedValue<NoInverse>, 3> NamesOf(NoInverse) {
  return {{{"nan", NoInverse::kNan}, {"zero", NoInverse::kZero}, {"nearest", NoInverse::kNearest}}};
}

// A path is empty if the file is not requested. Lengths are in the unit of the surface that the
// grid surrounds: the source or, for an inverse field, the target.
struct FieldSettings {
  // The displacement field to write. The ending is that of a format (io/field/field_format.h).
  std::string field;
  // The rigid placement to write: .tfm for ITK, any other ending for a matrix in text.
  std::string rigid;
  // The distance of the grid's points, >= 0. 0: a quarter of the distance of the nodes, or as much
  // more as keeps the grid below two million points.
  double spacing = 0.0;
  // Whether points of the target are mapped to the source, as resampling of images needs it.
  bool inverse = false;
  SurfaceAxes frame = SurfaceAxes::kLps;
  SurfaceUnit unit = SurfaceUnit::kMillimetres;
  NoInverse no_inverse = NoInverse::kNan;
  // How far the grid reaches beyond the surface, in distances of the nodes, >= 0.
  double margin = 2.0;
  // The box of the grid "x0,x1,y0,y1,z0,z1" in the coordinates of the surface; empty: around the
  // surface, with the margin.
  std::string bounds;
  // An image whose grid is used (io/field/grid_reader.h).
  std::string like;
  // The largest field that is made, in MB of the file before compression, > 0.
  double max_mb = 512.0;
  // The number of threads, >= 1. The result does not depend on it.
  int num_threads = 1;

  bool HasOutput() const { return !field.empty() || !rigid.empty(); }

  // The options as data: name, range and text of each.
  static const OptionTable<FieldSettings>& Rows();
};

// Returns the box in `bounds`; nothing if it is empty. The error says what was expected.
StatusOr<std::optional<Eigen::AlignedBox3d>> ParseBounds(const std::string& bounds);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_APPLY_FIELD_SETTINGS_H_
