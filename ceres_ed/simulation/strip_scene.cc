// The scene of the strip: a band of any length.
#include <ceres_ed/simulation/scene.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kPi = 3.14159265358979323846;

// The width of the band and the height of the camera, in metres.
constexpr double kWidth = 0.07;
constexpr double kCameraHeight = 0.1;
// The length of the tissue beyond both ends of the strip, so that the first and the last picture
// are full. The relief is up to 7.2 mm deep, which shows 4 mm more at either end, and the waves
// move it by 2 mm.
constexpr double kEnd = 0.012;
// The spacing of the vertices that are drawn, and the usual and the widest spacing of the truth, in
// metres.
constexpr double kPatchSpacing = 0.75e-3;
constexpr double kTruthSpacing = 1.5e-3;
constexpr double kWidestTruthSpacing = 4e-3;

// A sine wave of the surface height: height, wavelengths along x and y, and phase. The wavelengths
// have no common multiple, so that no two places look alike.
struct Relief {
  double height;
  double along;
  double across;
  double phase;
};
constexpr Relief kReliefs[] = {{3.5e-3, 0.0913, 0.211, 0.3},
                               {1.8e-3, 0.0531, -0.0877, 1.7},
                               {1.0e-3, 0.0317, 0.0291, 4.1},
                               {0.5e-3, -0.0191, 0.0167, 2.9},
                               {0.4e-3, 0.0127, 0.0331, 5.3}};

// A wave that travels through the band: how far it moves the tissue (metres), its wavelengths along
// x and y, and its period as a multiple of the period of the scene.
struct Wave {
  double x, y, z;
  double along;
  double across;
  double period;
};
constexpr Wave kWaves[] = {{0.4e-3, 0.3e-3, 1.2e-3, 0.113, 0.31, 1.0},
                           {0.3e-3, -0.2e-3, 0.5e-3, -0.0617, 0.143, 1.37},
                           {-0.15e-3, 0.2e-3, 0.3e-3, 0.0389, -0.0713, 0.79}};

// The vertices first, first + 1, ... of a line with the given spacing.
struct Line {
  int first;
  int count;
  double spacing;

  double At(int k) const { return (first + k) * spacing; }
};

class StripScene : public SyntheticScene {
 public:
  StripScene(double length, int frames, double period, const PinholeCamera& camera)
      : length_(length), view_(StripViewLength(camera)), frames_(frames), period_(period) {
    CHECK_GE(frames, 1);
    CHECK_GE(period, 2.0);
    CHECK_GE(length, view_ * (1.0 - 1e-12));
  }

  int num_frames() const override { return frames_; }
  int MaxVertices() const override { return VerticesAt(kTruthSpacing); }
  int MinVertices() const override { return VerticesAt(kWidestTruthSpacing); }

  PointCloud RestMesh(int vertices) const override {
    double spacing = kTruthSpacing;
    const auto size = [&] {
      return ((length_ + 2.0 * kEnd) / spacing + 1.0) * (kWidth / spacing + 2.0);
    };
    while (vertices < MaxVertices() && size() > vertices) spacing *= 1.01;
    return Band(-kEnd, length_ + kEnd, spacing);
  }

  // The patch is longer by a quarter of a view at each end than what a flat band would show.
  PointCloud RestPatch(int frame) const override {
    const double x = CameraX(frame);
    return Band(std::max(-kEnd, x - 0.75 * view_),
                std::min(length_ + kEnd, x + 0.75 * view_),
                kPatchSpacing);
  }

  Eigen::Vector3d Deform(int frame, const Eigen::Vector3d& rest) const override {
    Eigen::Vector3d point = rest;
    for (const Wave& wave : kWaves) {
      const double place = 2.0 * kPi * (rest.x() / wave.along + rest.y() / wave.across);
      const double time = 2.0 * kPi * frame / (wave.period * period_);
      // The value at frame 0 is subtracted, because the tissue is at rest there.
      const double swing = std::sin(place - time) - std::sin(place);
      point += swing * Eigen::Vector3d(wave.x, wave.y, wave.z);
    }
    return point;
  }

  CameraPose WorldFromCamera(int frame) const override {
    const Eigen::Vector3d eye(CameraX(frame), 0.0, kCameraHeight);
    return LookAt(eye, {eye.x(), 0.0, 0.0}, Eigen::Vector3d::UnitY());
  }

 private:
  // Returns the middle of the view: it moves from half a view after one end to half a view before
  // the other.
  double CameraX(int frame) const {
    const double share = frames_ == 1 ? 0.0 : static_cast<double>(frame) / (frames_ - 1);
    return 0.5 * view_ + share * (length_ - view_);
  }

  // Returns the number of vertices for a spacing, limited to the range of int.
  int VerticesAt(double spacing) const {
    const double count = (length_ + 2.0 * kEnd) * kWidth / (spacing * spacing);
    return static_cast<int>(std::min(std::ceil(count), 2e9));
  }

  static double Height(double x, double y) {
    double z = 0.0;
    for (const auto& [height, along, across, phase] : kReliefs) {
      z += height * std::sin(2.0 * kPi * (x / along + y / across) + phase);
    }
    return z;
  }

  // The vertices lie at integer multiples of the spacing along x, so that the same vertices occur
  // again when the ends move.
  static PointCloud Band(double begin, double end, double spacing) {
    const Line along = {
        static_cast<int>(std::ceil(begin / spacing)),
        static_cast<int>(std::floor(end / spacing) - std::ceil(begin / spacing)) + 1,
        spacing};
    const int rows = static_cast<int>(std::ceil(kWidth / spacing)) + 1;
    PointCloud band;
    for (int i = 0; i < along.count; ++i) {
      for (int j = 0; j < rows; ++j) {
        const double x = along.At(i);
        const double y = kWidth * (static_cast<double>(j) / (rows - 1) - 0.5);
        band.points.emplace_back(x, y, Height(x, y));
      }
    }
    for (int i = 0; i + 1 < along.count; ++i) {
      for (int j = 0; j + 1 < rows; ++j) {
        const int a = i * rows + j;
        const int b = a + rows;
        band.triangles.push_back({a, b, b + 1});
        band.triangles.push_back({a, b + 1, a + 1});
      }
    }
    return band;
  }

  double length_;
  double view_;
  int frames_;
  double period_;
};

}  // namespace

double StripViewLength(const PinholeCamera& camera) {
  return kCameraHeight * camera.width / camera.fx;
}

std::unique_ptr<SyntheticScene> MakeStripScene(double length,
                                               int frames,
                                               double period,
                                               const PinholeCamera& camera) {
  return std::make_unique<StripScene>(length, frames, period, camera);
}

}  // namespace ceres_ed
