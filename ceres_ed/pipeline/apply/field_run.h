// Writes the transform of a warp for other tools.
#ifndef CERES_ED_PIPELINE_APPLY_FIELD_RUN_H_
#define CERES_ED_PIPELINE_APPLY_FIELD_RUN_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/io/field/field_format.h>
#include <ceres_ed/pipeline/apply/field_settings.h>
#include <ceres_ed/pipeline/apply/warp_field.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/run_observer.h>

#include <string>

namespace ceres_ed {

// What was written.
struct WrittenField {
  // The grid, in the coordinates of the file.
  FieldGrid grid;
  // The distance of the grid's points in the unit of the surfaces.
  double spacing = 0.0;
  // Whether the file is in patient coordinates (left-posterior-superior, mm), and not in those of
  // the surfaces.
  bool is_lps = false;
  double megabytes = 0.0;
  // The error of the interpolated field at the surface.
  FieldError error;
  // For an inverse field.
  InverseQuality inverse;
};

// A RunObserver that also receives what was written.
class FieldObserver : public RunObserver {
 public:
  // Is called before the grid is filled; `error` and `inverse` have no values yet.
  virtual void OnGrid(const WrittenField& /*planned*/) {}
  virtual void OnField(const WrittenField& /*written*/) {}
  // `sentence` says what the file of the placement maps.
  virtual void OnRigid(const std::string& /*sentence*/) {}
};

// A field in the coordinates of a file, and what is known of it.
struct MadeField {
  DisplacementField field;
  WrittenField about;
};

// Fills the grid that `settings` ask for as a file of `format` has it, into `made`, and writes
// nothing; `settings.field` names it in messages. The other arguments are those of RunField().
Outcome MakeField(const FieldSettings& settings,
                  const FieldFormat& format,
                  const std::string& warp_path,
                  const Warp& warp,
                  const PointCloud* cloud,
                  FieldObserver* observer,
                  MadeField* made);

// Writes the files that `settings` name. `warp_path` names the warp in messages. `cloud`, if it is
// not null, is a cloud in the frame of the source: the grid surrounds it, and the error of the
// field is measured against what ApplyWarp() makes of it. Without a cloud, the nodes and the points
// of the finish take its place.
Outcome RunField(const FieldSettings& settings,
                 const std::string& warp_path,
                 const Warp& warp,
                 const PointCloud* cloud,
                 FieldObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_APPLY_FIELD_RUN_H_
