// The table of checks: a new one is a file in checks/ and a row here.
//
// A check adds a finding if there is something to say. It takes no longer than building a k-d tree.
#ifndef CERES_ED_PREFLIGHT_CHECK_TABLE_H_
#define CERES_ED_PREFLIGHT_CHECK_TABLE_H_

#include <ceres_ed/preflight/finding.h>

#include <vector>

namespace ceres_ed {

using CloudCheck = void (*)(const Specimen& specimen, std::vector<Finding>* findings);
using PairCheck = void (*)(const Specimen& source,
                           const Specimen& target,
                           std::vector<Finding>* findings);

// Vertices at 0 0 0 that were not measured, and vertices far from all others.
void CheckStrayVertices(const Specimen& specimen, std::vector<Finding>* findings);
// Coordinates far from the origin that floats cannot hold.
void CheckFloatPositions(const Specimen& specimen, std::vector<Finding>* findings);
// Triangles that are wound against their neighbours.
void CheckWinding(const Specimen& specimen, std::vector<Finding>* findings);
// Normals that contradict the triangles, or each other.
void CheckNormals(const Specimen& specimen, std::vector<Finding>* findings);
// Triangles that share no vertices, with gaps of rounding errors between them.
void CheckSoup(const Specimen& specimen, std::vector<Finding>* findings);
// Triangles that are there twice.
void CheckDuplicateFaces(const Specimen& specimen, std::vector<Finding>* findings);
// Triangles without area.
void CheckDegenerateFaces(const Specimen& specimen, std::vector<Finding>* findings);
// Edges of more than two triangles.
void CheckNonManifoldEdges(const Specimen& specimen, std::vector<Finding>* findings);
// Surfaces with folds that are narrower than the nodes of a fit are apart.
void CheckDetail(const Specimen& specimen, std::vector<Finding>* findings);

// Sizes that differ as units do.
void CheckUnits(const Specimen& source, const Specimen& target, std::vector<Finding>* findings);
// A target that is a mirror image of the source.
void CheckMirrored(const Specimen& source, const Specimen& target, std::vector<Finding>* findings);
// Surfaces that hardly overlap where they are.
void CheckOverlap(const Specimen& source, const Specimen& target, std::vector<Finding>* findings);

inline constexpr CloudCheck kCloudChecks[] = {CheckStrayVertices,
                                              CheckFloatPositions,
                                              CheckWinding,
                                              CheckNormals,
                                              CheckSoup,
                                              CheckDuplicateFaces,
                                              CheckDegenerateFaces,
                                              CheckNonManifoldEdges,
                                              CheckDetail};
inline constexpr PairCheck kPairChecks[] = {CheckUnits, CheckMirrored, CheckOverlap};

}  // namespace ceres_ed

#endif  // CERES_ED_PREFLIGHT_CHECK_TABLE_H_
