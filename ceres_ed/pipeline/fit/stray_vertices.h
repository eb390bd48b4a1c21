// Leaves out vertices of a file that are no part of its surface.
#ifndef CERES_ED_PIPELINE_FIT_STRAY_VERTICES_H_
#define CERES_ED_PIPELINE_FIT_STRAY_VERTICES_H_

#include <ceres_ed/io/cloud_io.h>

#include <string>

namespace ceres_ed {

// Removes unmeasured and far points (geometry/stray_points.h) from the cloud of `loaded`, and adds
// a sentence for each kind to its warnings, with their number and the first of them. The document
// is not changed, so that these vertices keep their rows when the cloud is written. `path` names
// the file in the sentences.
void LeaveOutStrayVertices(const std::string& path, LoadedCloud* loaded);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_STRAY_VERTICES_H_
