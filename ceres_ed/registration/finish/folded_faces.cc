#include "ceres_ed/registration/finish/folded_faces.h"

#include <ceres_ed/geometry/triangle_area.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace ceres_ed {
namespace {

// Shares of the area at rest: below the first a face is squeezed; above the second its surroundings
// are intact.
constexpr double kSqueezedShare = 0.05;
constexpr double kWholeShare = 0.2;
// Below this value the closed form loses too many digits, because two singular values nearly
// cancel.
constexpr double kMinDenominator = 1e-5;
constexpr int kMaxNewtonSteps = 30;

Eigen::Matrix3d RotationBySvd(const Eigen::Matrix3d& B) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(B, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

Eigen::Matrix3d Cofactors(const Eigen::Matrix3d& B) {
  Eigen::Matrix3d cofactors;
  cofactors.col(0) = B.col(1).cross(B.col(2));
  cofactors.col(1) = B.col(2).cross(B.col(0));
  cofactors.col(2) = B.col(0).cross(B.col(1));
  return cofactors;
}

}  // namespace

// The closed form of Markley, "Attitude determination using vector observations: a fast optimal
// matrix algorithm" (1993). With s_i the singular values, s_3 with the sign of det B, the maximum
// is lambda = s_1 + s_2 + s_3, which is the largest root of
//   p(x) = (x^2 - |B|^2)^2 - 8 x det B - 4 |cof B|^2,
// and p'(lambda) / 8 = (s_1 + s_2) (s_2 + s_3) (s_3 + s_1). It takes a tenth of the time of an SVD.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& B) {
  const double norm = B.norm();
  if (!(norm > 0.0)) return Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d M = B / norm;
  const Eigen::Matrix3d cofactors = Cofactors(M);
  const double det = M.col(0).dot(cofactors.col(0));
  const double cofactors_squared = cofactors.squaredNorm();
  // No root is larger than sqrt(3). Because all roots are real, Newton's method converges to the
  // largest one from above.
  double lambda = std::sqrt(3.0);
  double zeta = 0.0;
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const double excess = lambda * lambda - 1.0;
    const double value = excess * excess - 8.0 * lambda * det - 4.0 * cofactors_squared;
    zeta = 0.5 * lambda * excess - det;
    if (zeta < kMinDenominator) return RotationBySvd(B);
    const double change = value / (8.0 * zeta);
    lambda -= change;
    if (!(change > 1e-14)) break;
  }
  const double kappa = 0.5 * (lambda * lambda - 1.0);
  zeta = kappa * lambda - det;
  return ((kappa + 1.0) * M + lambda * cofactors - M * (M.transpose() * M)) / zeta;
}

FoldFinder::FoldFinder(const WeldedMesh& mesh, const std::vector<Eigen::Vector3d>& rest)
    : mesh_(mesh),
      rest_(rest),
      neighbor_offsets_(mesh.num_vertices() + 1, 0),
      rotations_(mesh.num_vertices()),
      stamps_(mesh.num_vertices(), 0) {
  for (const auto& [a, b] : mesh.edges) {
    ++neighbor_offsets_[a + 1];
    ++neighbor_offsets_[b + 1];
  }
  std::partial_sum(neighbor_offsets_.begin(), neighbor_offsets_.end(), neighbor_offsets_.begin());
  neighbors_.resize(neighbor_offsets_.back());
  std::vector<int> next(neighbor_offsets_.begin(), neighbor_offsets_.end() - 1);
  for (const auto& [a, b] : mesh.edges) {
    neighbors_[next[a]++] = b;
    neighbors_[next[b]++] = a;
  }
}

Eigen::Matrix3d FoldFinder::Rotation(int vertex, const std::vector<Eigen::Vector3d>& points) const {
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();
  for (int e = neighbor_offsets_[vertex]; e < neighbor_offsets_[vertex + 1]; ++e) {
    const int to = neighbors_[e];
    B += (points[to] - points[vertex]) * (rest_[to] - rest_[vertex]).transpose();
  }
  return NearestRotation(B);
}

bool FoldFinder::IsSqueezed(int face, const std::vector<Eigen::Vector3d>& points) const {
  double now = 0.0;
  double before = 0.0;
  for (const int corner : mesh_.triangles[face]) {
    for (int e = mesh_.around_offsets[corner]; e < mesh_.around_offsets[corner + 1]; ++e) {
      if (mesh_.around[e] == face) continue;
      now += AreaVector(points, mesh_.triangles[mesh_.around[e]]).norm();
      before += AreaVector(rest_, mesh_.triangles[mesh_.around[e]]).norm();
    }
  }
  return now > kWholeShare * before;
}

std::vector<int> FoldFinder::Find(const std::vector<int>& faces,
                                  const std::vector<Eigen::Vector3d>& points) {
  ++stamp_;
  std::vector<int> folded;
  for (const int face : faces) {
    const std::array<int, 3>& t = mesh_.triangles[face];
    Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
    for (const int v : t) {
      if (stamps_[v] != stamp_) rotations_[v] = Rotation(v, points);
      stamps_[v] = stamp_;
      turn += rotations_[v];
    }
    const Eigen::Vector3d before = AreaVector(rest_, t);
    const Eigen::Vector3d now = AreaVector(points, t);
    const bool is_small =
        now.squaredNorm() < kSqueezedShare * kSqueezedShare * before.squaredNorm();
    if ((turn * before).dot(now) < 0.0 || (is_small && IsSqueezed(face, points))) {
      folded.push_back(face);
    }
  }
  return folded;
}

std::vector<int> FoldFinder::FindAll(const std::vector<Eigen::Vector3d>& points) {
  std::vector<int> faces(mesh_.triangles.size());
  std::iota(faces.begin(), faces.end(), 0);
  return Find(faces, points);
}

std::vector<int> FoldFinder::Grow(const std::vector<int>& faces, int rings) const {
  std::vector<int> grown;
  std::vector<char> is_in(rest_.size(), 0);
  const auto add = [&](int v) {
    if (is_in[v] == 0) grown.push_back(v);
    is_in[v] = 1;
  };
  for (const int face : faces) {
    for (const int v : mesh_.triangles[face]) add(v);
  }
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = grown.size();
    for (; begin < end; ++begin) ForNeighbors(grown[begin], add);
  }
  std::sort(grown.begin(), grown.end());
  return grown;
}

std::vector<int> FoldFinder::FacesAround(const std::vector<int>& vertices) const {
  std::vector<int> faces;
  for (const int v : vertices) {
    faces.insert(faces.end(),
                 mesh_.around.begin() + mesh_.around_offsets[v],
                 mesh_.around.begin() + mesh_.around_offsets[v + 1]);
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::vector<std::vector<int>> FoldFinder::Groups(const std::vector<int>& faces, int rings) const {
  // Computes the connected components of the grown set, numbered by their lowest vertex.
  const std::vector<int> grown = Grow(faces, rings);
  std::vector<int> group(rest_.size(), -1);
  for (const int v : grown) group[v] = -2;
  int count = 0;
  std::vector<int> todo;
  for (const int first : grown) {
    if (group[first] != -2) continue;
    group[first] = count;
    todo.push_back(first);
    while (!todo.empty()) {
      const int v = todo.back();
      todo.pop_back();
      ForNeighbors(v, [&](int to) {
        if (group[to] != -2) return;
        group[to] = count;
        todo.push_back(to);
      });
    }
    ++count;
  }
  std::vector<std::vector<int>> groups(count);
  for (const int face : faces) groups[group[mesh_.triangles[face][0]]].push_back(face);
  return groups;
}

}  // namespace ceres_ed
