// Reads the inputs of a fit of files, and writes its outputs except the report.
#ifndef CERES_ED_PIPELINE_FIT_FIT_FILES_H_
#define CERES_ED_PIPELINE_FIT_FIT_FILES_H_

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/pipeline/fit/named_landmarks.h>
#include <ceres_ed/preflight/finding.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/util/status.h>

#include <functional>
#include <string>
#include <vector>

namespace ceres_ed {

// A cloud file, as reports describe it.
struct CloudFile {
  std::string path;
  // The numbers of points and faces in the whole file, including points that cannot be used.
  int points = 0;
  int faces = 0;
  // The diagonal of the bounding box of the points that are used, in the unit of the file.
  double diagonal = 0.0;
};

// Everything that a fit reads.
struct FitFiles {
  CloudFile source;
  // Its path is empty if only landmarks are fitted.
  CloudFile target;
  // The points of its clouds are the finite points of the files. Landmarks and fixed points are
  // indices of these points.
  FitInput input;
  // The document of the source and the rows of the points in it (LoadedCloud), with which the
  // result is written.
  PlyDocument source_document;
  std::vector<int> vertex_of_point;
  // Landmarks by name. If they are used for the fit, their constraints stand in `input`, from
  // number `named_begin` on.
  NamedLandmarks named;
  std::size_t named_begin = 0;
  std::vector<std::string> warnings;
  // What the checks of the inputs have found.
  std::vector<Finding> checks;
};

// The source of a fit as it was read. Fits of one source to many targets share it.
struct FitSource {
  CloudFile file;
  LoadedCloud loaded;
};

// Reads settings.source; mends it if settings.repair. The error names the file.
StatusOr<FitSource> LoadFitSource(const FitSettings& settings);

// Returns the inputs. Errors name the file, the place, the value and what was expected. Files are
// always read to their end; if `should_stop` returns true, the checks that are left are not made.
StatusOr<FitFiles> LoadFitFiles(const FitSettings& settings,
                                const std::function<bool()>& should_stop);

// Does the same with a source that has been read.
StatusOr<FitFiles> LoadFitFiles(const FitSettings& settings,
                                FitSource source,
                                const std::function<bool()>& should_stop);

// Returns ok if every output can be written. This is checked before the long computation. Creates
// the folders of the outputs if they do not exist.
Status PrepareOutputs(const FitSettings& settings);

// Writes the fitted source and, if they are requested, the warp and the graph. Each file is written
// atomically.
Status WriteFitFiles(const FitSettings& settings, const FitFiles& files, const FitResult& result);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_FILES_H_
