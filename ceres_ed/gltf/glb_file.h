// Reads and writes GLB files by tinygltf.
#ifndef CERES_ED_GLTF_GLB_FILE_H_
#define CERES_ED_GLTF_GLB_FILE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Fills `document` from the GLB file `path`, as ReadGlb() says (io/mesh/gltf_file.h).
Status ReadGlbFile(const std::string& path, PlyDocument* document);

// Writes to `bytes` a GLB file with `document`, as WriteGlb() says. Errors begin with `path`.
Status EncodeGlb(const std::string& path, const PlyDocument& document, std::string* bytes);

}  // namespace ceres_ed

#endif  // CERES_ED_GLTF_GLB_FILE_H_
