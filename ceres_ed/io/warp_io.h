// Reads and writes warp files: the deformation that a fit found, saved so that it can be applied to
// other clouds.
#ifndef CERES_ED_IO_WARP_IO_H_
#define CERES_ED_IO_WARP_IO_H_

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes `warp` to `path` as JSON. Numbers have enough digits to be read back with the same bits:
//   {"format": "ceres_ed_warp", "version": 1, "units_note": "...",
//    "target_from_source": {"scale": s, "rotation": [w, x, y, z], "translation": [x, y, z]},
//    "binding": {"neighbors": m, "distance": "surface" | "euclidean"},
//    "nodes": [{"g": [3], "A": [9, column by column], "t": [3]}, ...],
//    "edges": [[from, to, alpha], ...],
//    "inner_nodes": n,
//    "repaired": true,
//    "finish": {"points": [[x, y, z, dx, dy, dz], ...]}}
// "inner_nodes" is written only if there are any: the last n nodes lie inside the body. "repaired"
// is written only if the source was mended before the fit. "finish" is written only if the warp has
// one: points of the source and their displacements. The camera and the number of threads are not
// written. Returns an error if a number in `warp` is not
// finite, or with the system's reason.
Status WriteWarp(const std::string& path, const Warp& warp);

// Reads the warp in `path`. The error names file, field and what was expected: the file is not
// JSON, has another format or a newer version, or a field is missing, has the wrong type or length,
// or is out of range. Unknown fields are ignored.
StatusOr<Warp> ReadWarp(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_WARP_IO_H_
