// What a fit of files reads, and what it writes beside its report.
#ifndef CERES_ED_PIPELINE_FIT_FIT_FILES_H_
#define CERES_ED_PIPELINE_FIT_FIT_FILES_H_

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// A PLY file, as reports describe it.
struct CloudFile {
  std::string path;
  // The counts of the whole file, including the points that cannot be used.
  int points = 0;
  int faces = 0;
  // The diagonal of the bounding box of the points that are used, in the unit of the file.
  double diagonal = 0.0;
};

// Everything that was read.
struct FitFiles {
  CloudFile source;
  // Its path is empty where landmarks alone are fitted.
  CloudFile target;
  // Points are those of the files that are finite; landmarks and fixed points index these.
  FitInput input;
  // To put the result back into the source's file.
  PlyDocument source_document;
  std::vector<int> vertex_of_point;
  std::vector<std::string> warnings;
};

// Returns the inputs. Errors name file, place, value and what was expected.
StatusOr<FitFiles> LoadFitFiles(const FitSettings& settings);

// Returns ok when every output can be written, for the long work comes first. Makes the folders
// that outputs are in where they are missing.
Status PrepareOutputs(const FitSettings& settings);

// Writes the fitted source, the warp and the graph, where they are wanted, each atomically.
Status WriteFitFiles(const FitSettings& settings, const FitFiles& files, const FitResult& result);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_FILES_H_
