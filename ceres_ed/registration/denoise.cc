#include "ceres_ed/registration/denoise.h"

#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/welded_mesh.h>
#include <ceres_ed/solver/linear_algebra_backend.h>
#include <ceres_ed/solver/sparse_cholesky.h>

#include <cmath>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Of normals, radians.
constexpr double kAcceptedTurn = 0.1;
// See the header: of the turn of normals, and of the noise that is left.
constexpr double kTurnPerSlope = 0.742;
constexpr double kLeftOfNoise = 0.465;

double MeanEdge(const WeldedMesh& mesh, const std::vector<Eigen::Vector3d>& points) {
  double sum = 0.0;
  for (const auto& [a, b] : mesh.edges) {
    sum += (points[mesh.point_of_vertex[a]] - points[mesh.point_of_vertex[b]]).norm();
  }
  return mesh.edges.empty() ? 0.0 : sum / static_cast<double>(mesh.edges.size());
}

Eigen::MatrixXd Smoothed(const WeldedMesh& mesh, const Eigen::MatrixXd& points, double length) {
  const ScopedSerialLinearAlgebra serial;
  SparseCholesky::Matrix matrix = SquaredLaplacian(mesh);
  // An isolated vertex stays.
  Eigen::VectorXd degrees = Eigen::VectorXd::Zero(mesh.num_vertices());
  for (const auto& [a, b] : mesh.edges) {
    degrees[a] += 1.0;
    degrees[b] += 1.0;
  }
  const Eigen::VectorXd hold = degrees.cwiseMax(1.0) / std::pow(length, 4);
  // The diagonal is the first entry of its column.
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    matrix.valuePtr()[matrix.outerIndexPtr()[v]] += hold[v];
  }
  SparseCholesky factor(matrix);
  CHECK(factor.Factorize(matrix)) << "a sum of squares and a positive diagonal";
  return factor.Solve(hold.asDiagonal() * points);
}

}  // namespace

Denoised Denoise(const Surface& surface, double noise) {
  Denoised denoised;
  denoised.noise = noise;
  const WeldedMesh mesh = BuildWeldedMesh(surface.cloud(), surface.topology());
  const double edge = MeanEdge(mesh, surface.cloud().points);
  if (!(noise > 0.0) || !(edge > 0.0)) return denoised;
  const double length = std::sqrt(kTurnPerSlope * noise / (kAcceptedTurn * edge));
  if (length < 1.0) return denoised;
  denoised.length = length;
  denoised.noise = kLeftOfNoise * noise / length;

  Eigen::MatrixXd points(mesh.num_vertices(), 3);
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    points.row(v) = surface.cloud().points[mesh.point_of_vertex[v]].transpose();
  }
  const Eigen::MatrixXd smoothed = Smoothed(mesh, points, length);
  PointCloud& cloud = denoised.cloud;
  cloud = surface.cloud();
  cloud.normals.clear();
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    cloud.points[p] = smoothed.row(mesh.vertex_of_point[p]).transpose();
  }
  EnsureNormals(&cloud);
  // Along the surface points stay where they were: the border keeps its place.
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
