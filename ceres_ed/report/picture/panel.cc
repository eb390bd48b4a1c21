#include "ceres_ed/report/picture/panel.h"

#include <ceres_ed/geometry/mesh_raster.h>
#include <ceres_ed/geometry/normals.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

constexpr int kSupersampling = 2;
constexpr double kAmbient = 0.55;
constexpr double kDirect = 0.55;
// Nodes and edges are seen through this share of the distance behind a surface.
constexpr double kLift = 0.01;
// The height of the camera's pyramid of vision, as a share of the radius of the scene.
constexpr double kPyramid = 0.22;

Rgb Shaded(const Eigen::Vector3d& color, double cosine) {
  const double light = kAmbient + kDirect * cosine;
  Rgb shaded{};
  for (std::size_t c = 0; c < 3; ++c) {
    shaded[c] = static_cast<std::uint8_t>(
        std::lround(std::clamp(light * color[static_cast<Eigen::Index>(c)], 0.0, 255.0)));
  }
  return shaded;
}

Eigen::Vector3d AsVector(const Rgb& color) {
  return {1.0 * color[0], 1.0 * color[1], 1.0 * color[2]};
}

// Draws at the size of the supersampled picture.
class PanelPainter {
 public:
  PanelPainter(const PanelContents& contents, const PanelCamera& camera, const ThemeColors& colors)
      : contents_(contents),
        camera_(camera),
        colors_(colors),
        picture_(camera.pinhole().width, camera.pinhole().height, colors.ground),
        depth_(camera.pinhole().width,
               camera.pinhole().height,
               std::numeric_limits<float>::infinity()) {}

  ColorImage Draw();

 private:
  std::vector<Eigen::Vector3d> PointColors() const;
  void DrawFaces(const std::vector<Eigen::Vector3d>& points,
                 const std::vector<Eigen::Vector3d>& colors);
  void DrawPoints(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<Eigen::Vector3d>& colors);
  void DrawGraph();
  void DrawLandmarks(const std::vector<Eigen::Vector3d>& points);
  // Draws the way of the camera until now, and its pyramid of vision.
  void DrawPath();
  // Draws a disc of `radius` pixels that faces the eye, at a point in the frame of the eye.
  void DrawDisc(const Eigen::Vector3d& at, double radius, const Rgb& color, double lift);
  void DrawLine(const Eigen::Vector3d& from,
                const Eigen::Vector3d& to,
                double radius,
                const Rgb& color,
                double lift);
  // The unit of widths: a two hundredth of the height.
  double Unit() const { return picture_.height() / 200.0; }

  const PanelContents& contents_;
  const PanelCamera& camera_;
  const ThemeColors& colors_;
  ColorImage picture_;
  Image<float> depth_;
};

std::vector<Eigen::Vector3d> PanelPainter::PointColors() const {
  const ViewSurface& surface = *contents_.surface;
  const ScalarField* const field =
      contents_.field.empty() ? nullptr : surface.Find(contents_.field);
  std::vector<Eigen::Vector3d> colors(surface.points.size(), AsVector(contents_.plain));
  if (contents_.field == kOwnColors && !surface.colors.empty()) {
    for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = AsVector(surface.colors[i]);
  }
  if (field == nullptr) return colors;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const std::size_t at = surface.IndexOf(*field, static_cast<int>(i), contents_.at);
    const bool is_hidden = field->hides_aside && !field->aside.empty() && field->aside[at] != 0;
    colors[i] = AsVector(is_hidden ? kUnknownColor
                                   : ColorAt(field->scale, field->range.PartOf(field->values[at])));
  }
  return colors;
}

void PanelPainter::DrawFaces(const std::vector<Eigen::Vector3d>& points,
                             const std::vector<Eigen::Vector3d>& colors) {
  PointCloud cloud;
  cloud.points = points;
  cloud.triangles = contents_.surface->triangles;
  const std::vector<Eigen::Vector3d> normals = ComputeVertexNormals(cloud);
  const MeshRaster raster = RasterizeMesh(points, cloud.triangles, camera_.pinhole());
  for (int v = 0; v < picture_.height(); ++v) {
    for (int u = 0; u < picture_.width(); ++u) {
      if (raster.fragments(u, v).triangle < 0) continue;
      const Eigen::Vector3d normal = raster.Interpolate(cloud.triangles, normals, u, v);
      const Eigen::Vector3d color = raster.Interpolate(cloud.triangles, colors, u, v);
      const Eigen::Vector3d ray = camera_.pinhole().BackProject(u, v, 1.0).normalized();
      const double length = normal.norm();
      const double cosine = length > 0.0 ? std::abs(normal.dot(ray)) / length : 1.0;
      picture_(u, v) = Shaded(color, cosine);
      depth_(u, v) = raster.depth(u, v);
    }
  }
}

void PanelPainter::DrawPoints(const std::vector<Eigen::Vector3d>& points,
                              const std::vector<Eigen::Vector3d>& colors) {
  // Points that fill a disc of the scene's size, half of them behind the others.
  double radius =
      std::clamp(0.5 * picture_.height() / std::sqrt(static_cast<double>(points.size()) + 1.0),
                 1.0,
                 6.0 * Unit());
  const ViewSurface& surface = *contents_.surface;
  if (surface.spacing > 0.0) {
    // Discs that touch, at the distance of the middle of the scene.
    radius = std::clamp(1.1 * camera_.PixelsOf(surface.spacing), 1.0, 6.0 * Unit());
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!surface.IsThere(static_cast<int>(i), contents_.at)) continue;
    double cosine = 1.0;
    if (!surface.normals.empty() && surface.normals[i].norm() > 0.5) {
      cosine = std::abs(camera_.TurnToEye(surface.normals[i]).dot(points[i].normalized()));
    }
    DrawDisc(points[i], radius, Shaded(colors[i], cosine), 0.0);
  }
}

void PanelPainter::DrawDisc(const Eigen::Vector3d& at,
                            double radius,
                            const Rgb& color,
                            double lift) {
  if (!(at.z() > 0.0)) return;
  const Eigen::Vector2d center = camera_.pinhole().Project(at);
  if (!center.allFinite() || center.cwiseAbs().maxCoeff() > 1e6) return;
  const float z = static_cast<float>(at.z() * (1.0 - lift));
  const int reach = static_cast<int>(std::ceil(radius));
  const int u0 = static_cast<int>(std::lround(center.x()));
  const int v0 = static_cast<int>(std::lround(center.y()));
  for (int v = v0 - reach; v <= v0 + reach; ++v) {
    for (int u = u0 - reach; u <= u0 + reach; ++u) {
      if (!picture_.Contains(u, v) || depth_(u, v) < z) continue;
      if ((Eigen::Vector2d(u, v) - center).squaredNorm() > radius * radius) continue;
      picture_(u, v) = color;
      depth_(u, v) = z;
    }
  }
}

void PanelPainter::DrawLine(const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to,
                            double radius,
                            const Rgb& color,
                            double lift) {
  if (!(from.z() > 0.0) || !(to.z() > 0.0)) return;
  const double pixels = (camera_.pinhole().Project(to) - camera_.pinhole().Project(from)).norm();
  const int steps = std::clamp(static_cast<int>(std::min(pixels, 1e5)), 1, 4 * picture_.width());
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    DrawDisc((1.0 - part) * from + part * to, radius, color, lift);
  }
}

void PanelPainter::DrawGraph() {
  const ViewSurface& surface = *contents_.surface;
  if (contents_.graph == nullptr || !surface.motion) return;
  const MotionParts parts = PartsAt(contents_.at, PlacementShareOf(surface));
  std::vector<Eigen::Vector3d> nodes;
  nodes.reserve(contents_.graph->kinds.size());
  for (int j = 0; j < static_cast<int>(contents_.graph->kinds.size()); ++j) {
    nodes.push_back(camera_.ToEye(surface.motion->MoveNode(j, parts)));
  }
  for (const auto& [from, to] : contents_.graph->edges) {
    DrawLine(nodes[from], nodes[to], 0.35 * Unit(), colors_.edge, kLift);
  }
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const NodeKind kind = contents_.graph->kinds[j];
    const Rgb color = kind == NodeKind::kPr   ? kPrColor
                      : kind == NodeKind::kPi ? kPiColor
                                              : kOtherNodeColor;
    DrawDisc(nodes[j], (kind == NodeKind::kPr ? 1.5 : 1.2) * Unit(), color, 1.2 * kLift);
  }
}

void PanelPainter::DrawLandmarks(const std::vector<Eigen::Vector3d>& points) {
  if (contents_.landmarks == nullptr) return;
  for (const ViewLandmark& landmark : *contents_.landmarks) {
    const Eigen::Vector3d wanted = camera_.ToEye(landmark.wanted);
    DrawLine(points[landmark.point], wanted, 0.5 * Unit(), kLandmarkColor, 2.0 * kLift);
    DrawDisc(wanted, 1.5 * Unit(), kLandmarkColor, 2.0 * kLift);
  }
}

void PanelPainter::DrawPath() {
  if (contents_.timeline == nullptr || !contents_.surface->moments) return;
  const Timeline& timeline = *contents_.timeline;
  const int now = timeline.moments[contents_.surface->moments->MomentAt(contents_.at)];
  std::optional<Eigen::Vector3d> last;
  for (int f = 0; f <= now; ++f) {
    if (!timeline.frames[f].map_from_camera) continue;
    const Eigen::Vector3d at = camera_.ToEye(timeline.frames[f].map_from_camera->translation);
    if (last) DrawLine(*last, at, 0.5 * Unit(), kPrColor, kLift);
    last = at;
  }
  if (!timeline.frames[now].map_from_camera) return;
  // The pyramid of vision.
  const double size = kPyramid * contents_.scene_radius;
  std::vector<Eigen::Vector3d> corners;
  for (const auto& [u, v] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
    const Eigen::Vector3d ray = timeline.camera.BackProject(
        u * (timeline.camera.width - 1), v * (timeline.camera.height - 1), size);
    corners.push_back(camera_.ToEye(*timeline.frames[now].map_from_camera * ray));
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    DrawLine(*last, corners[i], 0.5 * Unit(), kLandmarkColor, kLift);
    DrawLine(corners[i], corners[(i + 1) % corners.size()], 0.5 * Unit(), kLandmarkColor, kLift);
  }
}

ColorImage PanelPainter::Draw() {
  std::vector<Eigen::Vector3d> points = PointsAt(*contents_.surface, contents_.at);
  for (Eigen::Vector3d& point : points) point = camera_.ToEye(point);
  const std::vector<Eigen::Vector3d> colors = PointColors();
  if (contents_.surface->triangles.empty()) {
    DrawPoints(points, colors);
  } else {
    DrawFaces(points, colors);
  }
  DrawGraph();
  DrawLandmarks(points);
  DrawPath();
  return std::move(picture_);
}

// Returns the picture at its size: the mean of the pixels in each square.
ColorImage Smaller(const ColorImage& large) {
  ColorImage small(large.width() / kSupersampling, large.height() / kSupersampling);
  constexpr int kCount = kSupersampling * kSupersampling;
  for (int v = 0; v < small.height(); ++v) {
    for (int u = 0; u < small.width(); ++u) {
      for (std::size_t c = 0; c < 3; ++c) {
        int sum = kCount / 2;
        for (int k = 0; k < kCount; ++k) {
          sum += large(kSupersampling * u + k % kSupersampling,
                       kSupersampling * v + k / kSupersampling)[c];
        }
        small(u, v)[c] = static_cast<std::uint8_t>(sum / kCount);
      }
    }
  }
  return small;
}

}  // namespace

PanelCamera::PanelCamera(
    const ViewCamera& camera, const SceneBall& ball, const ViewFrame& frame, int width, int height)
    : center_(ball.center), radius_(ball.radius) {
  constexpr double kRadiansPerDegree = M_PI / 180.0;
  const Eigen::Vector3d right = camera.up.cross(camera.from).normalized();
  eye_from_scene_.row(0) = right;
  eye_from_scene_.row(1) = -camera.from.cross(right);
  eye_from_scene_.row(2) = -camera.from;
  distance_ = 1.0 / std::sin(0.5 * kViewAngleDeg * kRadiansPerDegree);
  const Eigen::Vector2d size = frame.high - frame.low;
  const double focal = std::min(width / size.x(), height / size.y());
  const Eigen::Vector2d middle = 0.5 * (frame.low + frame.high);
  pinhole_ = {focal,
              focal,
              0.5 * (width - 1) - focal * middle.x(),
              0.5 * (height - 1) - focal * middle.y(),
              width,
              height};
}

Eigen::AlignedBox2d PanelCamera::Extent(const std::vector<Eigen::Vector3d>& points) const {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d at = ToEye(point);
    box.extend(Eigen::Vector2d(at.x() / at.z(), at.y() / at.z()));
  }
  return box;
}

Eigen::Vector3d PanelCamera::ToEye(const Eigen::Vector3d& point) const {
  return eye_from_scene_ * ((point - center_) / radius_) + Eigen::Vector3d(0.0, 0.0, distance_);
}

ColorImage DrawPanel(const PanelContents& contents,
                     const ViewCamera& camera,
                     const SceneBall& ball,
                     const ViewFrame& frame,
                     int width,
                     int height,
                     Theme theme) {
  const PanelCamera panel_camera(
      camera, ball, frame, kSupersampling * width, kSupersampling * height);
  const ThemeColors colors = ColorsOf(theme);
  return Smaller(PanelPainter(contents, panel_camera, colors).Draw());
}

}  // namespace ceres_ed
