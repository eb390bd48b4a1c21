// What ed_fit reads, and what it writes beside its report.
#ifndef CERES_ED_APPS_FIT_FILES_H_
#define CERES_ED_APPS_FIT_FILES_H_

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <apps/fit_flags.h>

namespace ceres_ed {

// A PLY file, as reports describe it.
struct CloudFile {
  std::string path;
  // Of the file, those that are no use included.
  int points = 0;
  int faces = 0;
  // Of the bounding box of what is used, in the unit of the file.
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

// Returns the inputs: `arguments` are SOURCE and, where there is one, TARGET. Errors name file,
// place, value and what was expected.
StatusOr<FitFiles> LoadFitFiles(const std::vector<std::string>& arguments,
                                const FitSettings& settings);

// Returns ok when every output can be written: asked ahead of the long work.
Status CheckOutputs(const FitSettings& settings);

// Writes the fitted source, the warp and the graph, where they are wanted, each atomically.
Status WriteFitFiles(const FitSettings& settings, const FitFiles& files, const FitResult& result);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_FIT_FILES_H_
