#include "ceres_ed/registration/denoise.h"

#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/welded_mesh.h>
#include <ceres_ed/linear_algebra/sparse_cholesky.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The accepted rotation of normals by noise, in radians.
constexpr double kAcceptedTurn = 0.1;
// The factors of the header: for the rotation of normals, and for the remaining noise.
constexpr double kTurnPerSlope = 0.742;
constexpr double kLeftOfNoise = 0.465;
// The smallest share of the mean squared edge that is free of noise; a smaller value cannot be
// distinguished from an error of the estimated noise.
constexpr double kMinCleanShare = 0.25;

// Returns the mean edge length without the contribution of the noise: the ends of an edge differ by
// sqrt(2) noise across the surface.
double CleanEdge(const WeldedMesh& mesh, const std::vector<Eigen::Vector3d>& points, double noise) {
  double sum = 0.0;
  double squares = 0.0;
  for (const auto& [a, b] : mesh.edges) {
    const Eigen::Vector3d edge = points[mesh.point_of_vertex[a]] - points[mesh.point_of_vertex[b]];
    sum += edge.norm();
    squares += edge.squaredNorm();
  }
  if (!(squares > 0.0)) return 0.0;
  const double count = static_cast<double>(mesh.edges.size());
  const double clean_share = 1.0 - 2.0 * noise * noise * count / squares;
  return sum / count * std::sqrt(std::max(kMinCleanShare, clean_share));
}

// Reverses all `normals` if they point against `given` on the whole: the triangles of a file may be
// wound against its normals.
void TakeSideOf(const std::vector<Eigen::Vector3d>& given, std::vector<Eigen::Vector3d>* normals) {
  double agreement = 0.0;
  for (std::size_t p = 0; p < given.size(); ++p) agreement += given[p].dot((*normals)[p]);
  if (agreement >= 0.0) return;
  for (Eigen::Vector3d& normal : *normals) normal = -normal;
}

// Returns the smoothed points; none if `should_stop` has returned true.
Eigen::MatrixXd Smoothed(const WeldedMesh& mesh,
                         const Eigen::MatrixXd& points,
                         double length,
                         const std::function<bool()>& should_stop) {
  SparseCholesky::Matrix matrix = SquaredLaplacian(mesh);
  // An isolated vertex keeps its position.
  Eigen::VectorXd degrees = Eigen::VectorXd::Zero(mesh.num_vertices());
  for (const auto& [a, b] : mesh.edges) {
    degrees[a] += 1.0;
    degrees[b] += 1.0;
  }
  const Eigen::VectorXd hold = degrees.cwiseMax(1.0) / std::pow(length, 4);
  // The diagonal is the first entry of each column.
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    matrix.valuePtr()[matrix.outerIndexPtr()[v]] += hold[v];
  }
  bool stopped = false;
  const auto must_stop = [&] {
    stopped = stopped || (should_stop && should_stop());
    return stopped;
  };
  SparseCholesky factor(matrix, must_stop);
  if (!factor.Factorize(matrix, must_stop)) {
    CHECK(stopped) << "a sum of squares and a positive diagonal";
    return {};
  }
  return factor.Solve(hold.asDiagonal() * points);
}

}  // namespace

Denoised Denoise(const Surface& surface, double noise, const std::function<bool()>& should_stop) {
  Denoised denoised;
  denoised.noise = noise;
  const WeldedMesh mesh = BuildWeldedMesh(surface.cloud(), surface.topology());
  const double edge = CleanEdge(mesh, surface.cloud().points, noise);
  if (!(noise > 0.0) || !(edge > 0.0)) return denoised;
  const double length = std::sqrt(kTurnPerSlope * noise / (kAcceptedTurn * edge));
  if (length < 1.0) return denoised;
  Eigen::MatrixXd points(mesh.num_vertices(), 3);
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    points.row(v) = surface.cloud().points[mesh.point_of_vertex[v]].transpose();
  }
  const Eigen::MatrixXd smoothed = Smoothed(mesh, points, length, should_stop);
  if (smoothed.rows() != points.rows()) return denoised;
  denoised.length = length;
  denoised.noise = kLeftOfNoise * noise / length;
  PointCloud& cloud = denoised.cloud;
  cloud = surface.cloud();
  cloud.normals.clear();
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    cloud.points[p] = smoothed.row(mesh.vertex_of_point[p]).transpose();
  }
  EnsureNormals(&cloud);
  if (cloud.HasTriangles()) TakeSideOf(surface.cloud().normals, &cloud.normals);
  // Points do not move along the surface, so that the border keeps its place.
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    const Eigen::Vector3d& normal = cloud.normals[p];
    const Eigen::Vector3d& before = surface.cloud().points[p];
    if (normal.dot(surface.cloud().normals[p]) < 0.0 && !cloud.HasTriangles()) {
      cloud.normals[p] = -normal;
    }
    cloud.points[p] = before + normal * normal.dot(cloud.points[p] - before);
  }
  cloud.normals_oriented = surface.cloud().normals_oriented;
  return denoised;
}

}  // namespace ceres_ed
