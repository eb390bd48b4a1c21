#include "ceres_ed/pipeline/fit/named_landmarks.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/io/mesh/mesh_space.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/pipeline/fit/carried_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace ceres_ed {
namespace {

// A landmark that is farther from its surface than this share of the diagonal is likely to be in
// another frame.
constexpr double kFarShare = 0.05;

using Positions = std::vector<Eigen::Vector3d>;

double MedianDistance(const std::vector<NamedLandmark>& points,
                      const KdTree& tree,
                      bool is_turned) {
  std::vector<double> distances;
  for (const NamedLandmark& point : points) {
    const Eigen::Vector3d at =
        is_turned ? BetweenSpaces(point.position, AnatomicalSpace::kRas, AnatomicalSpace::kLps)
                  : point.position;
    distances.push_back(std::sqrt(tree.Nearest(at).squared_distance));
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

// Warns of landmarks that do not lie at their surface, with the likely reason.
void CheckDistances(const SurfaceLandmarks& side,
                    const std::vector<NamedLandmark>& points,
                    std::vector<std::string>* warnings) {
  const double diagonal = Diagonal(side.surface.cloud.points);
  if (side.surface.cloud.empty() || !(diagonal > 0.0)) return;
  const KdTree tree(side.surface.cloud.points);
  const double median = MedianDistance(points, tree, false);
  const double turned = MedianDistance(points, tree, true);
  if (median <= kFarShare * diagonal) return;
  constexpr double kMuchNearer = 0.25;
  const bool is_turned = turned < kMuchNearer * median;
  const int percent = static_cast<int>(std::lround(100.0 * median / diagonal));
  warnings->push_back(side.name + ": in the median the landmarks are " + std::to_string(percent) +
                      " % of the diagonal away from the points of " + side.mesh +
                      (is_turned ? ", and close with x and y turned: is that mesh in RAS where the "
                                   "file says LPS, or the other way round (--mesh_space)?"
                                 : ": do both have the same frame and unit?"));
}

// Returns the landmarks in the space of their mesh.
std::vector<NamedLandmark> InSpaceOfMesh(const SurfaceLandmarks& side,
                                         MeshSpace setting,
                                         std::vector<std::string>* warnings) {
  warnings->insert(warnings->end(), side.file.warnings.begin(), side.file.warnings.end());
  const AnatomicalSpace space = SpaceOfMesh(setting, side.surface.document);
  std::vector<NamedLandmark> points = side.file.points;
  for (NamedLandmark& point : points) {
    point.position = BetweenSpaces(point.position, side.file.space, space);
  }
  CheckDistances(side, points, warnings);
  return points;
}

// Returns "'a', 'b' and 3 more".
std::string ListOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    list += (i == 0 ? "" : ", ") + Quoted(names[i]);
  }
  if (names.size() > kMost) list += " and " + std::to_string(names.size() - kMost) + " more";
  return list;
}

void WarnOfSingles(const std::string& path,
                   const std::vector<std::string>& names,
                   std::vector<std::string>* warnings) {
  if (names.empty()) return;
  warnings->push_back(path + ": without a partner and not used: " + ListOf(names));
}

// Returns the vertices that take the part of a landmark: the corners of the nearest triangle or, if
// `several` is false or there are no triangles, the nearest vertex.
std::vector<int> VerticesNear(const Eigen::Vector3d& landmark,
                              const PointCloud& source,
                              const SurfaceIndex& surface,
                              const KdTree& tree,
                              bool several) {
  const SurfaceHit hit = surface.Closest(landmark);
  if (!hit.found()) return {tree.Nearest(landmark).index};
  if (hit.triangle < 0 || !several) return {hit.nearest_vertex};
  const std::array<int, 3>& corners = source.triangles[static_cast<std::size_t>(hit.triangle)];
  return {corners.begin(), corners.end()};
}

}  // namespace

AnatomicalSpace SpaceOfMesh(MeshSpace setting, const PlyDocument& document) {
  if (setting == MeshSpace::kLps) return AnatomicalSpace::kLps;
  if (setting == MeshSpace::kRas) return AnatomicalSpace::kRas;
  const AnatomicalSpace own = SpaceOfDocument(document);
  return own == AnatomicalSpace::kUnknown ? AnatomicalSpace::kLps : own;
}

StatusOr<NamedLandmarks> MatchLandmarks(MeshSpace setting,
                                        const SurfaceLandmarks& source,
                                        const SurfaceLandmarks& target) {
  NamedLandmarks named;
  const std::vector<NamedLandmark> on_source = InSpaceOfMesh(source, setting, &named.warnings);
  const std::vector<NamedLandmark> on_target = InSpaceOfMesh(target, setting, &named.warnings);
  std::map<std::string, Eigen::Vector3d> partners;
  for (const NamedLandmark& point : on_target) partners[point.name] = point.position;
  std::set<std::string> used;
  for (const NamedLandmark& point : on_source) {
    const auto partner = partners.find(point.name);
    if (partner == partners.end()) {
      named.only_source.push_back(point.name);
      continue;
    }
    used.insert(point.name);
    named.pairs.push_back({point.name, point.position, partner->second});
  }
  for (const NamedLandmark& point : on_target) {
    if (used.count(point.name) == 0) named.only_target.push_back(point.name);
  }
  if (named.pairs.empty()) {
    return Status::Error(source.name + " and " + target.name +
                         ": no name is in both, expected the same names: " +
                         ListOf(named.only_source) + " against " + ListOf(named.only_target));
  }
  WarnOfSingles(source.name, named.only_source, &named.warnings);
  WarnOfSingles(target.name, named.only_target, &named.warnings);
  return named;
}

StatusOr<NamedLandmarks> LoadNamedLandmarks(const FitSettings& settings,
                                            const LandmarkSurface& source,
                                            const LandmarkSurface& target) {
  StatusOr<LandmarkFile> on_source =
      ReadLandmarkFile(settings.source_landmarks, LandmarkSide::kSource);
  if (!on_source.ok()) return on_source.status();
  StatusOr<LandmarkFile> on_target =
      ReadLandmarkFile(settings.target_landmarks, LandmarkSide::kTarget);
  if (!on_target.ok()) return on_target.status();
  return MatchLandmarks(
      settings.mesh_space,
      {settings.source, settings.source_landmarks, source, *std::move(on_source)},
      {settings.target, settings.target_landmarks, target, *std::move(on_target)});
}

std::vector<Landmark> LandmarkConstraints(const std::vector<LandmarkPair>& pairs,
                                          const PointCloud& source) {
  Positions from;
  Positions to;
  for (const LandmarkPair& pair : pairs) {
    from.push_back(pair.source);
    to.push_back(pair.target);
  }
  const StatusOr<Similarity> similarity = Similarity::FitPoints(from, to, /*with_scale=*/true);
  const SurfaceIndex surface(source);
  const KdTree tree(source.points);
  std::set<int> taken;
  std::vector<Landmark> constraints;
  for (const LandmarkPair& pair : pairs) {
    for (const int vertex : VerticesNear(pair.source, source, surface, tree, similarity.ok())) {
      if (!taken.insert(vertex).second) continue;
      Eigen::Vector3d position = pair.target;
      if (similarity.ok()) {
        const Eigen::Vector3d offset =
            source.points[static_cast<std::size_t>(vertex)] - pair.source;
        position += similarity->scale * (similarity->rotation * offset);
      }
      constraints.push_back({vertex, position});
    }
  }
  return constraints;
}

std::vector<LandmarkError> MeasureLandmarkPairs(const std::vector<LandmarkPair>& pairs,
                                                const PointCloud& source,
                                                const std::vector<Eigen::Vector3d>& fitted,
                                                const Similarity& rigid,
                                                double scale) {
  std::vector<LandmarkError> errors;
  if (pairs.empty() || fitted.empty()) return errors;
  Positions positions;
  for (const LandmarkPair& pair : pairs) positions.push_back(pair.source);
  const Positions carried = CarryPoints(source, fitted, rigid, positions);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    LandmarkError error;
    error.before = (scale * pairs[i].source - pairs[i].target).norm();
    error.rigid = (rigid * pairs[i].source - pairs[i].target).norm();
    error.after = (carried[i] - pairs[i].target).norm();
    errors.push_back(error);
  }
  return errors;
}

}  // namespace ceres_ed
