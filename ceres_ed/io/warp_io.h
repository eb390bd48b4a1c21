// Warp files: the deformation that a fit found, kept to be applied to other clouds.
#ifndef CERES_ED_IO_WARP_IO_H_
#define CERES_ED_IO_WARP_IO_H_

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns ok when `path` holds `warp` as JSON, numbers with as many digits as bring back the same
// bits:
//   {"format": "ceres_ed_warp", "version": 1, "units_note": "...",
//    "target_from_source": {"scale": s, "rotation": [w, x, y, z], "translation": [x, y, z]},
//    "binding": {"neighbors": m, "distance": "surface" | "euclidean"},
//    "nodes": [{"g": [3], "A": [9, column by column], "t": [3]}, ...],
//    "edges": [[from, to, alpha], ...],
//    "finish": {"points": [[x, y, z, dx, dy, dz], ...]}}
// with "finish" only where the warp has one: points of the source and their displacements.
// Errors: a number in `warp` that is not finite, or the system's reason. The camera and the number
// of threads are not written.
Status WriteWarp(const std::string& path, const Warp& warp);

// Returns the warp in `path`, or an error that names file, field and what was expected: not JSON,
// another format, a newer version, a field that is missing, of the wrong type or length, or out of
// range. Fields that it does not know are ignored.
StatusOr<Warp> ReadWarp(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_WARP_IO_H_
