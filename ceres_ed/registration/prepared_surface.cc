#include "ceres_ed/registration/prepared_surface.h"

#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/orientation.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

// The largest shares of normals that may contradict the triangles, or each other. Sharp edges and
// noise cause some contradictions.
constexpr double kMaxAgainstTriangles = 0.02;
constexpr double kMaxContradicting = 0.01;
// The smallest share of the points that one connected part must have for the signs of estimated
// normals to be believed.
constexpr double kLeastPart = 0.9;

// Gives points without a normal the normals of `computed`.
void FillIn(const std::vector<Eigen::Vector3d>& computed, std::vector<Eigen::Vector3d>* normals) {
  for (std::size_t p = 0; p < normals->size(); ++p) {
    if ((*normals)[p].isZero(0.0)) (*normals)[p] = computed[p];
  }
}

bool HasUnknownNormals(const PointCloud& cloud) {
  for (const Eigen::Vector3d& normal : cloud.normals) {
    if (normal.isZero(0.0)) return true;
  }
  return false;
}

// Returns whether some normals of a mesh are unknown, or too many contradict its triangles.
bool HasDoubtfulNormals(const PointCloud& cloud) {
  return HasUnknownNormals(cloud) || ShareOfNormalsAgainstTriangles(cloud) > kMaxAgainstTriangles;
}

// Makes the given normals of a mesh agree with its triangles.
void ReconcileMesh(const std::string& name, PointCloud* cloud, std::vector<std::string>* notes) {
  double against = ShareOfNormalsAgainstTriangles(*cloud);
  if (against > 0.5) {
    ReverseOrientation(cloud);
    for (Eigen::Vector3d& normal : cloud->normals) normal = -normal;
    notes->push_back("the normals of " + name +
                     " point to the inner side of its triangles: the normals are believed");
    against = 1.0 - against;
  }
  if (against > kMaxAgainstTriangles) {
    cloud->normals.clear();
    notes->push_back(std::to_string(std::lround(100.0 * against)) + " % of the normals of " + name +
                     " contradict its triangles: all are computed anew");
    EnsureNormals(cloud);
  } else if (HasUnknownNormals(*cloud)) {
    FillIn(ComputeVertexNormals(*cloud), &cloud->normals);
  }
}

// Makes the given normals of bare points agree with each other.
void ReconcilePoints(const std::string& name,
                     int num_threads,
                     PointCloud* cloud,
                     std::vector<std::string>* notes) {
  const bool has_unknown = HasUnknownNormals(*cloud);
  if (has_unknown) {
    FillIn(EstimateNormals(cloud->points, kNormalNeighbors, num_threads), &cloud->normals);
  }
  const double contradicting = ShareOfContradictingNormals(*cloud);
  if (contradicting <= kMaxContradicting) return;
  ChooseNormalSigns(cloud->points, &cloud->normals, kNormalNeighbors, num_threads);
  const bool is_consistent = ShareOfContradictingNormals(*cloud) <= kMaxContradicting;
  if (!is_consistent) cloud->normals_oriented = false;
  if (has_unknown && contradicting < 0.05) return;
  notes->push_back("normals of neighbouring points of " + name + " point to opposite sides: " +
                   (is_consistent ? "their signs are chosen anew" : "their signs are not used"));
}

}  // namespace

PreparedSurface PrepareSurface(PointCloud cloud,
                               const std::string& name,
                               int num_threads,
                               const std::function<bool()>& should_stop) {
  const auto stopped = [&should_stop] { return should_stop && should_stop(); };
  PreparedSurface prepared;
  const bool has_normals = cloud.HasNormals();
  if (stopped()) {
    if (!has_normals) cloud.normals.assign(cloud.size(), Eigen::Vector3d::Zero());
    prepared.surface = std::make_unique<const Surface>(std::move(cloud), num_threads);
    return prepared;
  }
  if (!has_normals && !cloud.HasTriangles()) {
    // The sides of separate parts are guesses that need not agree.
    int largest = 0;
    cloud.normals = EstimateNormals(cloud.points, kNormalNeighbors, num_threads, &largest);
    cloud.normals_oriented = largest >= kLeastPart * static_cast<double>(cloud.size()) &&
                             ShareOfContradictingNormals(cloud) <= kMaxContradicting;
  }
  if (has_normals && !cloud.HasTriangles() && cloud.normals_oriented) {
    ReconcilePoints(name, num_threads, &cloud, &prepared.notes);
  }
  prepared.surface = std::make_unique<const Surface>(std::move(cloud), num_threads);
  if (!prepared.surface->cloud().HasTriangles() || stopped()) return prepared;

  const std::vector<int> against =
      TrianglesAgainstNeighbors(prepared.surface->cloud(), prepared.surface->topology());
  const bool reconcile =
      has_normals && (!against.empty() || HasDoubtfulNormals(prepared.surface->cloud()));
  if (against.empty() && !reconcile) return prepared;
  PointCloud mended = prepared.surface->cloud();
  for (const int t : against) std::swap(mended.triangles[t][1], mended.triangles[t][2]);
  if (!against.empty()) {
    prepared.notes.push_back(std::to_string(against.size()) + " of " +
                             std::to_string(mended.triangles.size()) + " triangles of " + name +
                             " are wound against their neighbours: they are reversed");
  }
  if (reconcile) {
    ReconcileMesh(name, &mended, &prepared.notes);
  } else {
    mended.normals.clear();
  }
  prepared.surface = std::make_unique<const Surface>(std::move(mended), num_threads);
  return prepared;
}

std::unique_ptr<const Surface> Reversed(const Surface& surface, int num_threads) {
  PointCloud cloud = surface.cloud();
  ReverseOrientation(&cloud);
  return std::make_unique<const Surface>(std::move(cloud), num_threads);
}

bool AreBothClosed(const Surface& source, const Surface& target, bool* opposite) {
  const double source_volume = EnclosedVolume(source.cloud(), source.topology());
  const double target_volume = EnclosedVolume(target.cloud(), target.topology());
  *opposite = source_volume * target_volume < 0.0;
  return source_volume * target_volume != 0.0;
}

}  // namespace ceres_ed
