#include "ceres_ed/simulation/views.h"

#include <ceres_ed/geometry/triangle_area.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kPi = 3.14159265358979323846;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The projection of the mesh into the picture, with its triangles sorted into a grid of cells.
class Picture {
 public:
  Picture(const PointCloud& mesh, const SyntheticView& view) : mesh_(mesh), view_(view) {
    CHECK((view.look_at - view.eye).norm() > 0.0) << "the view has no direction";
    CHECK(view.half_angle_deg > 0.0 && view.half_angle_deg <= 89.0) << view.half_angle_deg;
    forward_ = (view.look_at - view.eye).normalized();
    const Eigen::Vector3d right = forward_.unitOrthogonal();
    const Eigen::Vector3d down = forward_.cross(right);
    const double widest = std::tan(view.half_angle_deg / 180.0 * kPi);
    for (const Eigen::Vector3d& point : mesh.points) {
      const Eigen::Vector3d ray = point - view.eye;
      const double depth = forward_.dot(ray);
      const double divisor = view.parallel ? 1.0 : depth;
      const bool is_ahead = view.parallel || depth > 0.0;
      image_.emplace_back(is_ahead ? right.dot(ray) / divisor : 0.0,
                          is_ahead ? down.dot(ray) / divisor : 0.0);
      // A value that is linear over a triangle's image: the negative depth for parallel rays, the
      // inverse depth for a pinhole.
      nearness_.push_back(view.parallel ? -depth : 1.0 / depth);
      is_ahead_.push_back(is_ahead);
      is_inside_.push_back(is_ahead && (view.parallel || image_.back().norm() <= widest));
    }
    FillGrid();
  }

  bool Faces(const std::array<int, 3>& t) const {
    const Eigen::Vector3d& a = mesh_.points[t[0]];
    const Eigen::Vector3d normal = AreaVector(mesh_.points, t);
    return normal.dot(view_.parallel ? Eigen::Vector3d(-forward_)
                                     : Eigen::Vector3d(view_.eye - a)) > 0.0;
  }

  bool IsInside(int vertex) const { return is_inside_[vertex] != 0; }

  bool IsHidden(int vertex) const {
    for (const int t : cells_[Cell(image_[vertex])]) {
      if (Hides(mesh_.triangles[t], vertex)) return true;
    }
    return false;
  }

 private:
  void FillGrid() {
    lower_ = Eigen::Vector2d::Constant(1e300);
    Eigen::Vector2d upper = -lower_;
    for (std::size_t k = 0; k < image_.size(); ++k) {
      if (!is_ahead_[k]) continue;
      lower_ = lower_.cwiseMin(image_[k]);
      upper = upper.cwiseMax(image_[k]);
    }
    side_ = std::max(1, static_cast<int>(std::sqrt(mesh_.triangles.size() / 2.0)));
    pitch_ = std::max((upper - lower_).maxCoeff() / side_, 1e-300);
    cells_.resize(static_cast<std::size_t>(side_) * side_);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      if (!is_ahead_[a] || !is_ahead_[b] || !is_ahead_[c]) continue;
      const Eigen::Vector2d low = image_[a].cwiseMin(image_[b]).cwiseMin(image_[c]);
      const Eigen::Vector2d high = image_[a].cwiseMax(image_[b]).cwiseMax(image_[c]);
      for (int row = Index(low, 1); row <= Index(high, 1); ++row) {
        for (int column = Index(low, 0); column <= Index(high, 0); ++column) {
          cells_[row * side_ + column].push_back(static_cast<int>(t));
        }
      }
    }
  }

  int Index(const Eigen::Vector2d& image, int axis) const {
    const double index = std::floor((image[axis] - lower_[axis]) / pitch_);
    return static_cast<int>(std::clamp(index, 0.0, side_ - 1.0));
  }
  int Cell(const Eigen::Vector2d& image) const { return Index(image, 1) * side_ + Index(image, 0); }

  bool Hides(const std::array<int, 3>& t, int vertex) const {
    if (t[0] == vertex || t[1] == vertex || t[2] == vertex) return false;
    const Eigen::Vector2d& p = image_[vertex];
    double weights[3];
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d& from = image_[t[(k + 1) % 3]];
      weights[k] = Cross(image_[t[(k + 2) % 3]] - from, p - from);
    }
    const double area = weights[0] + weights[1] + weights[2];
    if (area == 0.0) return false;
    double nearness = 0.0;
    for (int k = 0; k < 3; ++k) {
      // A ray through an edge counts as cut, so that there is no gap between two triangles.
      if (weights[k] / area < -1e-12) return false;
      nearness += weights[k] / area * nearness_[t[k]];
    }
    return nearness > nearness_[vertex] + 1e-9 * std::abs(nearness_[vertex]);
  }

  const PointCloud& mesh_;
  const SyntheticView& view_;
  Eigen::Vector3d forward_;
  std::vector<Eigen::Vector2d> image_;
  std::vector<double> nearness_;
  std::vector<char> is_ahead_;
  std::vector<char> is_inside_;
  Eigen::Vector2d lower_;
  int side_ = 1;
  double pitch_ = 1.0;
  std::vector<std::vector<int>> cells_;
};

}  // namespace

std::vector<char> VisibleVertices(const PointCloud& mesh, const SyntheticView& view) {
  const Picture picture(mesh, view);
  std::vector<char> visible(mesh.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    if (!picture.Faces(triangle)) continue;
    for (const int vertex : triangle) visible[vertex] = 1;
  }
  for (std::size_t k = 0; k < mesh.size(); ++k) {
    const int vertex = static_cast<int>(k);
    if (visible[k] && (!picture.IsInside(vertex) || picture.IsHidden(vertex))) visible[k] = 0;
  }
  return visible;
}

PointCloud VisiblePart(const PointCloud& mesh, const SyntheticView& view, std::vector<int>* kept) {
  const std::vector<char> visible = VisibleVertices(mesh, view);
  const Picture picture(mesh, view);
  PointCloud part;
  std::vector<int> index(mesh.size(), -1);
  for (const auto& triangle : mesh.triangles) {
    if (!visible[triangle[0]] || !visible[triangle[1]] || !visible[triangle[2]]) continue;
    if (!picture.Faces(triangle)) continue;
    part.triangles.push_back(triangle);
    for (const int vertex : triangle) index[vertex] = 0;
  }
  if (kept != nullptr) kept->clear();
  for (std::size_t k = 0; k < mesh.size(); ++k) {
    if (index[k] < 0) continue;
    index[k] = static_cast<int>(part.size());
    part.points.push_back(mesh.points[k]);
    if (mesh.HasIntensities()) part.intensities.push_back(mesh.intensities[k]);
    if (mesh.HasNormals()) part.normals.push_back(mesh.normals[k]);
    if (kept != nullptr) kept->push_back(static_cast<int>(k));
  }
  part.normals_oriented = mesh.normals_oriented;
  for (auto& triangle : part.triangles) {
    for (int& vertex : triangle) vertex = index[vertex];
  }
  return part;
}

void AddSyntheticNoise(double sigma, std::uint64_t seed, PointCloud* cloud) {
  CHECK_GE(sigma, 0.0);
  Random random(seed);
  for (Eigen::Vector3d& point : cloud->points) {
    for (int axis = 0; axis < 3; ++axis) point[axis] += sigma * random.Gaussian();
  }
}

}  // namespace ceres_ed
