// The scenes that show one of the synthetic shapes: the organs and the plane.
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/scene.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadians = kPi / 180.0;

// A scene of one shape. Truth and pictures use the same mesh, so that exact depth lies on the
// truth.
class ShapeScene : public SyntheticScene {
 public:
  ShapeScene(SyntheticShape shape, int vertices, int frames)
      : shape_(shape),
        size_(DefaultSyntheticSize(shape)),
        frames_(frames),
        mesh_(MakeSyntheticShape(shape, vertices, size_)) {
    CHECK_GE(frames, 1);
  }

  int num_frames() const override { return frames_; }
  int MaxVertices() const override { return static_cast<int>(mesh_.size()); }
  int MinVertices() const override { return 500; }
  PointCloud RestMesh(int vertices) const override {
    return vertices >= MaxVertices()
               ? mesh_
               : MakeSyntheticShape(shape_, std::max(vertices, MinVertices()), size_);
  }
  PointCloud RestPatch(int /*frame*/) const override { return mesh_; }
  Eigen::Vector3d Deform(int frame, const Eigen::Vector3d& rest) const override {
    return DeformSyntheticPoint(shape_, size_, Phase(frame), rest);
  }

 protected:
  // Returns the phase of DeformSyntheticPoint(), 0 to 1.
  virtual double Phase(int frame) const = 0;

  const SyntheticShape shape_;
  const double size_;
  const int frames_;

 private:
  const PointCloud mesh_;
};

class OrganScene : public ShapeScene {
 public:
  OrganScene(SyntheticShape shape, int vertices, int frames, double period)
      : ShapeScene(shape, vertices, frames), period_(period) {
    CHECK_GE(period, 2.0);
    const PointCloud mesh = RestPatch(0);
    Eigen::Vector3d low = mesh.points[0];
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& point : mesh.points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    center_ = 0.5 * (low + high);
  }

  // The path starts 50 degrees left of the organ's front (-y) and slowly swings up and down, nearer
  // and farther.
  CameraPose WorldFromCamera(int frame) const override {
    constexpr double kDegreesPerFrame = 1.7;
    const double azimuth = (-90.0 - 50.0 + kDegreesPerFrame * frame) * kRadians;
    const double elevation = (10.0 + 10.0 * std::sin(2.0 * kPi * frame / 97.0)) * kRadians;
    const double radius = 0.85 * size_ * (1.0 + 0.04 * std::sin(2.0 * kPi * frame / 61.0));
    const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                    std::cos(elevation) * std::sin(azimuth),
                                    std::sin(elevation));
    return LookAt(center_ + radius * direction, center_, Eigen::Vector3d::UnitZ());
  }

 protected:
  double Phase(int frame) const override {
    return 0.5 * (1.0 - std::cos(2.0 * kPi * frame / period_));
  }

 private:
  double period_;
  Eigen::Vector3d center_;
};

class PlaneScene : public ShapeScene {
 public:
  PlaneScene(int vertices, int frames, const PinholeCamera& camera)
      : ShapeScene(SyntheticShape::kPlane, vertices, frames), camera_(camera) {}

  CameraPose WorldFromCamera(int /*frame*/) const override {
    return LookAt({0.0, 0.0, Height()}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY());
  }

  // Returns the middle of the sheet, which is half of its area.
  MaskImage Mask(int frame) const override {
    if (frame == 0) return {};
    const double half = 0.5 * size_ * std::sqrt(0.5);
    MaskImage mask(camera_.width, camera_.height, 0);
    for (int v = 0; v < camera_.height; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        const Eigen::Vector3d point = camera_.BackProject(u, v, Height());
        mask(u, v) = std::max(std::abs(point.x()), std::abs(point.y())) <= half ? 1 : 0;
      }
    }
    return mask;
  }

 protected:
  double Phase(int frame) const override {
    return frames_ == 1 ? 0.0 : 0.5 * (1.0 - std::cos(kPi * frame / (frames_ - 1)));
  }

 private:
  // Returns the height at which the sheet fills 90 % of the smaller side of the picture.
  double Height() const {
    return size_ / 0.9 * std::max(camera_.fx / camera_.width, camera_.fy / camera_.height);
  }

  PinholeCamera camera_;
};

}  // namespace

CameraPose LookAt(const Eigen::Vector3d& eye,
                  const Eigen::Vector3d& target,
                  const Eigen::Vector3d& up) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  Eigen::Matrix3d rotation;
  rotation << right, forward.cross(right), forward;
  CameraPose pose;
  pose.rotation = Eigen::Quaterniond(rotation).normalized();
  pose.translation = eye;
  return pose;
}

std::unique_ptr<SyntheticScene> MakeOrganScene(SyntheticShape shape,
                                               int vertices,
                                               int frames,
                                               double period) {
  return std::make_unique<OrganScene>(shape, vertices, frames, period);
}

std::unique_ptr<SyntheticScene> MakePlaneScene(int vertices,
                                               int frames,
                                               const PinholeCamera& camera) {
  return std::make_unique<PlaneScene>(vertices, frames, camera);
}

}  // namespace ceres_ed
