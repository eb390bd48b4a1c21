#include "ceres_ed/registration/intrinsic/intrinsic_match.h"

#include <ceres_ed/geometry/sampling.h>
#include <ceres_ed/registration/intrinsic/coarse_mesh.h>
#include <ceres_ed/registration/intrinsic/eigenfunctions.h>
#include <ceres_ed/registration/intrinsic/functional_map.h>
#include <ceres_ed/registration/intrinsic/laplacian.h>
#include <ceres_ed/registration/intrinsic/map_quality.h>
#include <ceres_ed/registration/intrinsic/map_search.h>
#include <ceres_ed/registration/intrinsic/wave_kernel.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace ceres_ed {
namespace {

// The number of vertices of the coarse mesh of a mesh, and of eigenfunctions.
constexpr int kVertices = 1500;
constexpr int kFunctions = 60;
// The number of eigenfunctions and energies of the signatures.
constexpr int kEnergies = 50;
// The smaller of two surfaces that are compared has at least this share of the area of the other,
// because bodies contract; or this, if its border is longer by a share of the vertices.
constexpr double kLeastAreaRatio = 0.5;
constexpr double kLeastOpenAreaRatio = 0.8;
constexpr double kLongerBorder = 0.02;
// The number of points with which maps are refined.
constexpr int kSpread = 400;
// The number of maps that are refined to the end.
constexpr int kMaps = 8;
// A match that comes back this many spacings away has the weight exp(-1/2).
constexpr double kReturnWidth = 1.5;
constexpr double kLeastWeight = 0.05;
// A map is of use if at least these shares of its triangles and vertices keep their side and
// return, and if its doubt (its cost divided by the first share) is at most this. Right maps of
// surfaces of one body have doubts of 0.1 to 0.7, wrong ones of 0.9 and more.
constexpr double kLeastOrientation = 0.7;
constexpr double kLeastReturning = 0.9;
constexpr double kMaxDoubt = 0.75;
// The orientation of a right map, where it cannot be measured.
constexpr double kUsualOrientation = 0.8;
// Maps with at most this times the doubt of the best one may be right, too; so many are kept.
constexpr double kPlausible = 1.4;
constexpr std::size_t kMostMaps = 4;

// A coarse mesh with its harmonics.
struct Shape {
  CoarseMesh mesh;
  SpectralBasis basis;
  std::vector<int> order;
};

// Returns whether `part` seems to show only a part of `whole`. It has other harmonics then.
bool IsPartOf(const CoarseMesh& part, const CoarseMesh& whole) {
  const bool is_open = part.border_share > whole.border_share + kLongerBorder;
  return part.area < (is_open ? kLeastOpenAreaRatio : kLeastAreaRatio) * whole.area;
}

// Returns the harmonics of a mesh, or nothing if they cannot be computed.
std::optional<Shape> MakeShape(CoarseMesh mesh) {
  Shape shape;
  shape.mesh = std::move(mesh);
  std::optional<SpectralBasis> basis = ComputeEigenfunctions(
      BuildLaplacian(shape.mesh.positions, shape.mesh.triangles, shape.mesh.triangle_weight),
      kFunctions);
  if (!basis.has_value()) return std::nullopt;
  shape.basis = *std::move(basis);
  FarthestPointOptions options;
  options.max_count = kSpread;
  shape.order = FarthestPointSample(shape.mesh.positions, options);
  return shape;
}

IntrinsicMatches MakeMatches(const Shape& source,
                             const Shape& target,
                             const PointMap& map,
                             double cost) {
  const SpectralPair spread = {&source.basis, &target.basis, source.order, target.order};
  const int size = spread.size();
  const Eigen::MatrixXd C = FunctionalMap(spread, map, size);
  const PointMap whole =
      NearestRows(source.basis.functions.leftCols(size) * C, target.basis.functions.leftCols(size));
  const MapQuality quality = MeasureMap(source.mesh, target.mesh, whole);
  IntrinsicMatches matches;
  matches.cost = cost;
  matches.orientation = quality.orientation;
  matches.returning = quality.returning;
  const std::vector<double> distances = ReturnDistances(source.mesh, whole);
  for (int i = 0; i < source.mesh.size(); ++i) {
    const double away = distances[i] / kReturnWidth;
    Correspondence match;
    match.point = source.mesh.points[i];
    match.target = target.mesh.positions[whole.forth[i]];
    match.weight = std::exp(-0.5 * away * away);
    if (match.weight > kLeastWeight) matches.correspondences.push_back(match);
  }
  return matches;
}

// Returns what speaks against a map.
double DoubtOf(const IntrinsicMatches& matches, bool oriented) {
  return matches.cost / (oriented ? matches.orientation : kUsualOrientation);
}

// Sorts the maps, the best first, and keeps those that may be right.
void KeepPlausible(bool oriented, std::vector<IntrinsicMatches>* found) {
  const auto is_wrong = [oriented](const IntrinsicMatches& m) {
    return (oriented && m.orientation < kLeastOrientation) || m.returning < kLeastReturning ||
           DoubtOf(m, oriented) > kMaxDoubt;
  };
  found->erase(std::remove_if(found->begin(), found->end(), is_wrong), found->end());
  std::stable_sort(found->begin(),
                   found->end(),
                   [oriented](const IntrinsicMatches& a, const IntrinsicMatches& b) {
                     return DoubtOf(a, oriented) < DoubtOf(b, oriented);
                   });
  if (found->empty()) return;
  const double most = kPlausible * DoubtOf(found->front(), oriented);
  while (found->size() > kMostMaps || DoubtOf(found->back(), oriented) > most) found->pop_back();
}

}  // namespace

std::vector<IntrinsicMatches> MatchIntrinsically(const Surface& source,
                                                 const Surface& target,
                                                 const std::function<bool()>& should_stop) {
  const auto stopped = [&] { return should_stop && should_stop(); };
  std::vector<CoarseMesh> source_parts = BuildCoarseMeshes(source, kVertices, should_stop);
  std::vector<CoarseMesh> target_parts = BuildCoarseMeshes(target, kVertices, should_stop);
  if (source_parts.empty() || target_parts.empty() || stopped()) return {};
  if (IsPartOf(source_parts[0], target_parts[0]) || IsPartOf(target_parts[0], source_parts[0])) {
    return {};
  }
  const std::optional<Shape> from = MakeShape(std::move(source_parts[0]));
  const std::optional<Shape> to = MakeShape(std::move(target_parts[0]));
  if (!from.has_value() || !to.has_value() || stopped()) return {};
  const int count = std::min(from->basis.size(), to->basis.size());
  if (count < 3) return {};
  const double low = std::min(from->basis.eigenvalues[1], to->basis.eigenvalues[1]);
  const double high =
      std::min(from->basis.eigenvalues[count - 1], to->basis.eigenvalues[count - 1]);
  if (!(low > 0.0) || !(low < high)) return {};
  Eigen::MatrixXd source_signature = WaveKernelSignature(from->basis, low, high, kEnergies);
  Eigen::MatrixXd target_signature = WaveKernelSignature(to->basis, low, high, kEnergies);
  ScaleSignatures(&source_signature, &target_signature);
  MapSearchInput input;
  input.source = &from->basis;
  input.target = &to->basis;
  input.source_signature = &source_signature;
  input.target_signature = &target_signature;
  input.target_points = &to->mesh.positions;
  input.source_order = from->order;
  input.target_order = to->order;
  input.should_stop = should_stop;
  std::vector<IntrinsicMatches> found;
  for (const RankedMap& map : SearchMaps(input, kMaps)) {
    found.push_back(MakeMatches(*from, *to, map.map, map.cost));
  }
  const bool oriented = from->mesh.oriented && to->mesh.oriented;
  KeepPlausible(oriented, &found);
  return found;
}

}  // namespace ceres_ed
