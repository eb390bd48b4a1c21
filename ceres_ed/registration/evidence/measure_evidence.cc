#include "ceres_ed/registration/evidence/measure_evidence.h"

#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Eigenvalues>

namespace ceres_ed {
namespace {

constexpr int kSamples = 4000;
// The distances of matched points, as a fraction of the diagonal and in deviations of the noise.
constexpr double kMatchedWithin = 0.01;
constexpr double kMatchedDeviations = 3.0;
// The cosine of the largest angle between the normals of matched points.
constexpr double kLeastCosine = 0.5;
// A surface is closed if fewer than this share of its points lie on its border.
constexpr double kClosedBorder = 0.01;
// The stretch that 5 % of the edges exceed.
constexpr double kStretchQuantile = 0.95;
// The patches on which the relief is measured: their number, and their radius.
constexpr std::size_t kPatches = 300;
constexpr double kPatchRadius = 0.1;
// The number of nearest points to which a bare point is linked.
constexpr int kLinks = 6;

bool IsClosed(const Surface& surface) {
  const std::vector<char>& border = surface.topology().is_border;
  const auto count = std::count(border.begin(), border.end(), 1);
  return static_cast<double>(count) < kClosedBorder * static_cast<double>(border.size());
}

enum class Cover { kMatched, kMissed, kUnseen };

// One surface as another one is compared with it. The pointers are not null.
struct Reference {
  const SurfaceIndex* index = nullptr;
  const std::vector<Eigen::Vector3d>* normals = nullptr;
  const PointCloud* cloud = nullptr;
  bool is_closed = false;
  bool oriented = true;
  // Distances along a surface of bare points up to this length are no distances from it.
  double spacing = 0.0;
};

struct Comparison {
  Cover cover = Cover::kUnseen;
  // The distance across the surface.
  double across = 0.0;
};

Eigen::Vector3d NormalAt(const Reference& reference, const SurfaceHit& hit) {
  if (hit.triangle < 0) return (*reference.normals)[hit.nearest_vertex];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    sum += hit.barycentric[i] * (*reference.normals)[reference.cloud->triangles[hit.triangle][i]];
  }
  return sum.normalized();
}

Comparison Compare(const Eigen::Vector3d& point,
                   const Eigen::Vector3d& normal,
                   const Reference& reference,
                   double within) {
  Comparison comparison;
  const SurfaceHit hit = reference.index->Closest(point);
  if (!hit.found()) return comparison;
  const Eigen::Vector3d other = NormalAt(reference, hit);
  double cosine = normal.dot(other);
  if (!reference.oriented) cosine = std::abs(cosine);
  const bool is_known = !normal.isZero() && !other.isZero();
  const bool agrees = !is_known || cosine > kLeastCosine;
  const Eigen::Vector3d gap = point - hit.position;
  comparison.across = is_known ? std::abs(gap.dot(other)) : gap.norm();
  const double along =
      std::sqrt(std::max(0.0, gap.squaredNorm() - comparison.across * comparison.across));
  const double distance = std::hypot(comparison.across, std::max(0.0, along - reference.spacing));
  if (distance <= within && agrees) {
    comparison.cover = Cover::kMatched;
  } else if (hit.on_border || (!agrees && !reference.is_closed)) {
    comparison.cover = Cover::kUnseen;
  } else {
    comparison.cover = Cover::kMissed;
  }
  return comparison;
}

// Returns the mean distance of each bare point from its nearest other one; 0 for a mesh.
double SpacingOf(const Surface& surface) {
  if (surface.topology().HasSurface()) return 0.0;
  double sum = 0.0;
  const std::vector<int> samples = SamplePoints(surface, kSamples / 8);
  std::vector<Neighbor> nearest;
  for (const int point : samples) {
    surface.tree().KNearest(surface.cloud().points[point], 2, &nearest);
    if (nearest.size() > 1) sum += std::sqrt(nearest[1].squared_distance);
  }
  return samples.empty() ? 0.0 : 2.0 * sum / static_cast<double>(samples.size());
}

// The samples of the surface that is compared with a reference.
struct ComparedSurface {
  const std::vector<int>* samples = nullptr;
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const std::vector<Eigen::Vector3d>* normals = nullptr;
  const std::vector<double>* areas = nullptr;
};

// Compares the samples of a surface with a reference; returns the sum of the squares of the matched
// distances across the surface, weighted by area, and the parts in `cover`.
double CompareAll(const ComparedSurface& compared,
                  const Reference& reference,
                  double within,
                  int num_threads,
                  std::vector<Comparison>* comparisons,
                  CoverEvidence* cover) {
  const std::vector<int>& samples = *compared.samples;
  const int count = static_cast<int>(samples.size());
  comparisons->assign(samples.size(), Comparison());
  ParallelFor(num_threads, count, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const int point = samples[i];
      (*comparisons)[i] =
          Compare((*compared.points)[point], (*compared.normals)[point], reference, within);
    }
  });
  double sums[3] = {0.0, 0.0, 0.0};
  double total = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Comparison& comparison = (*comparisons)[i];
    const double area = (*compared.areas)[samples[i]];
    sums[static_cast<int>(comparison.cover)] += area;
    total += area;
    if (comparison.cover == Cover::kMatched) {
      squares += area * comparison.across * comparison.across;
    }
  }
  if (!(total > 0.0)) return 0.0;
  *cover = {sums[0] / total, sums[1] / total, sums[2] / total};
  return squares / total;
}

double StretchQuantile(std::vector<double> stretches) {
  if (stretches.empty()) return -1.0;
  const auto at =
      stretches.begin() +
      static_cast<std::ptrdiff_t>(kStretchQuantile * static_cast<double>(stretches.size() - 1));
  std::nth_element(stretches.begin(), at, stretches.end());
  return *at;
}

void AddStretch(const Eigen::Vector3d& rest,
                const Eigen::Vector3d& fitted,
                std::vector<double>* stretches) {
  constexpr double kFlat = 1e-3;
  const double before = rest.norm();
  if (!(before > 0.0)) return;
  stretches->push_back(std::abs(std::log(std::max(kFlat, fitted.norm() / before))));
}

double EdgeStretch(const FittedSurfaces& fit) {
  const std::vector<Eigen::Vector3d>& rest = fit.source->cloud().points;
  const std::vector<Eigen::Vector3d>& fitted = *fit.points;
  std::vector<double> stretches;
  std::vector<Neighbor> nearest;
  for (const int point : SamplePoints(*fit.source, kSamples)) {
    const int from = fit.source->topology().representative[point];
    const auto add = [&](int to) {
      AddStretch(rest[to] - rest[from], fitted[to] - fitted[from], &stretches);
    };
    if (fit.source->topology().HasSurface()) {
      for (const SurfaceLink& link : fit.source->topology().Edges(from)) add(link.to);
      continue;
    }
    fit.source->tree().KNearest(rest[from], kLinks + 1, &nearest);
    for (const Neighbor& neighbor : nearest) add(neighbor.index);
  }
  return StretchQuantile(std::move(stretches));
}

double NodeStretch(const FittedSurfaces& fit) {
  const std::vector<Eigen::Vector3d>& rest = fit.source->cloud().points;
  const std::vector<int>& nodes = fit.graph->node_points;
  std::vector<double> stretches;
  const int num_surface_nodes = fit.graph->graph.num_surface_nodes();
  for (const GraphEdge& edge : fit.graph->graph.edges()) {
    if (std::max(edge.from, edge.to) >= num_surface_nodes) continue;
    const int a = nodes[edge.from];
    const int b = nodes[edge.to];
    AddStretch(rest[b] - rest[a], (*fit.points)[b] - (*fit.points)[a], &stretches);
  }
  return StretchQuantile(std::move(stretches));
}

// Returns FitEvidence::relief: over patches of the whole source around matched samples.
double MeasureRelief(const FittedSurfaces& fit,
                     const std::vector<int>& samples,
                     const std::vector<Comparison>& comparisons) {
  const PointCloud& source = fit.source->cloud();
  std::vector<Eigen::Vector3d> points;
  points.reserve(samples.size());
  for (const int point : samples) points.push_back(source.points[point]);
  const KdTree tree(points);
  std::vector<Neighbor> patch;
  double sum = 0.0;
  double total = 0.0;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kPatches);
  for (std::size_t i = 0; i < points.size(); i += step) {
    if (comparisons[i].cover != Cover::kMatched) continue;
    tree.RadiusSearch(points[i], kPatchRadius, &patch);
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
    for (const Neighbor& neighbor : patch) {
      const int point = samples[neighbor.index];
      const Eigen::Vector3d& normal = source.normals[point];
      mean += fit.source->relative_areas()[point] * normal * normal.transpose();
    }
    if (!(mean.trace() > 0.0)) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(mean / mean.trace(),
                                                               Eigen::EigenvaluesOnly);
    const double area = fit.source->relative_areas()[samples[i]];
    sum += area * std::sqrt(std::max(0.0, eigen.eigenvalues()[0] * eigen.eigenvalues()[1]));
    total += area;
  }
  return total > 0.0 ? sum / total : -1.0;
}

// Sets the bends: the distances from the best rigid motion.
void MeasureBends(const FittedSurfaces& fit,
                  const std::vector<int>& samples,
                  const std::vector<Comparison>& comparisons,
                  FitEvidence* evidence) {
  std::vector<Eigen::Vector3d> rest;
  std::vector<Eigen::Vector3d> fitted;
  for (const int point : samples) {
    rest.push_back(fit.source->cloud().points[point]);
    fitted.push_back((*fit.points)[point]);
  }
  const StatusOr<Similarity> rigid = Similarity::FitPoints(rest, fitted);
  const Similarity pose = rigid.ok() ? *rigid : Similarity();
  double sum = 0.0;
  double sum_matched = 0.0;
  int matched = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const double bend = (pose * rest[i] - fitted[i]).norm();
    sum += bend;
    if (comparisons[i].cover != Cover::kMatched) continue;
    sum_matched += bend;
    ++matched;
  }
  if (!rest.empty()) evidence->bend = sum / static_cast<double>(rest.size());
  if (matched > 0) evidence->bend_matched = sum_matched / matched;
}

}  // namespace

void MeasureEvidence(const FittedSurfaces& fit, FitEvidence* evidence) {
  const double within = std::max(kMatchedWithin, kMatchedDeviations * fit.noise);
  const Surface& source = *fit.source;
  const Surface& target = *fit.target;
  const bool oriented = source.cloud().normals_oriented && target.cloud().normals_oriented;
  const double spacing = std::max(SpacingOf(source), SpacingOf(target));
  // The source on the target.
  const Reference on_target = {&target.index(),
                               &target.cloud().normals,
                               &target.cloud(),
                               IsClosed(target),
                               oriented,
                               spacing};
  const std::vector<int> source_samples = SamplePoints(source, kSamples);
  std::vector<Comparison> of_source;
  const double source_squares =
      CompareAll({&source_samples, fit.points, fit.normals, &source.relative_areas()},
                 on_target,
                 within,
                 fit.num_threads,
                 &of_source,
                 &evidence->source);
  // The target on the fitted source, whose connections are those of the source.
  PointCloud fitted;
  fitted.points = *fit.points;
  fitted.triangles = source.cloud().triangles;
  const SurfaceIndex index(fitted, source.topology());
  const Reference on_source = {&index, fit.normals, &fitted, IsClosed(source), oriented, spacing};
  const std::vector<int> target_samples = SamplePoints(target, kSamples);
  std::vector<Comparison> of_target;
  const double target_squares = CompareAll(
      {&target_samples, &target.cloud().points, &target.cloud().normals, &target.relative_areas()},
      on_source,
      within,
      fit.num_threads,
      &of_target,
      &evidence->target);
  const double matched = evidence->source.matched + evidence->target.matched;
  if (matched > 0.0) evidence->residual = std::sqrt((source_squares + target_squares) / matched);
  evidence->edge_stretch = EdgeStretch(fit);
  evidence->node_stretch = NodeStretch(fit);
  evidence->relief = MeasureRelief(fit, source_samples, of_source);
  MeasureBends(fit, source_samples, of_source, evidence);
  evidence->noise = fit.noise;
  evidence->measured = true;
}

}  // namespace ceres_ed
