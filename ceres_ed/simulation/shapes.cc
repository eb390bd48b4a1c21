#include "ceres_ed/simulation/shapes.h"

#include <ceres_ed/simulation/meshing.h>

#include <algorithm>
#include <cmath>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

SyntheticSolid Dolphin() {
  SyntheticSolid solid(0.035);
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  solid.Add({{{0.39, 0, -0.002, 0.048},
              {0.33, 0, 0.000, 0.068},
              {0.24, 0, 0.000, 0.086},
              {0.12, 0, 0.000, 0.100},
              {0.00, 0, 0.000, 0.104},
              {-0.12, 0, 0.000, 0.092},
              {-0.24, 0, 0.004, 0.068},
              {-0.34, 0, 0.010, 0.045},
              {-0.42, 0, 0.014, 0.029},
              {-0.48, 0, 0.016, 0.020}}});
  // Beak.
  solid.Add(
      {{{0.39, 0, -0.022, 0.032}, {0.45, 0, -0.028, 0.022}, {0.515, 0, -0.030, 0.016}}, y, 1.0});
  // Dorsal fin, swept back.
  solid.Add({{{0.00, 0, 0.080, 0.062},
              {-0.035, 0, 0.125, 0.044},
              {-0.075, 0, 0.165, 0.028},
              {-0.110, 0, 0.188, 0.019}},
             y,
             0.38});
  for (const double side : {1.0, -1.0}) {
    // Pectoral fin, which is thin across the plane of its spine and the axis of the body.
    solid.Add({{{0.20, side * 0.060, -0.050, 0.042},
                {0.165, side * 0.115, -0.090, 0.036},
                {0.12, side * 0.160, -0.120, 0.028},
                {0.065, side * 0.190, -0.140, 0.019}},
               Eigen::Vector3d(0.0, side * 0.52, 0.85),
               0.42});
    // Half of the fluke.
    solid.Add({{{-0.475, 0, 0.016, 0.030},
                {-0.505, side * 0.050, 0.016, 0.040},
                {-0.535, side * 0.105, 0.016, 0.030},
                {-0.575, side * 0.150, 0.016, 0.020}},
               z,
               0.45});
  }
  return solid;
}

SyntheticSolid Heart() {
  SyntheticSolid solid(0.06);
  // Left ventricle with the apex, and the right ventricle in front of it.
  solid.Add({{{0.20, 0.00, -0.40, 0.08},
              {0.14, 0.00, -0.26, 0.17},
              {0.07, 0.02, -0.08, 0.25},
              {0.03, 0.03, 0.10, 0.25}}});
  solid.Add({{{0.09, -0.09, -0.29, 0.08},
              {-0.05, -0.12, -0.16, 0.15},
              {-0.15, -0.11, 0.00, 0.19},
              {-0.13, -0.11, 0.13, 0.15}}});
  // Right and left atrium.
  solid.Add({{{-0.25, 0.03, 0.14, 0.12}, {-0.24, 0.05, 0.24, 0.13}}});
  solid.Add({{{0.20, 0.06, 0.20, 0.12}, {0.10, 0.14, 0.24, 0.13}}});
  // Aorta with its arch, pulmonary trunk, superior vena cava.
  solid.Add({{{-0.03, 0.02, 0.22, 0.095},
              {-0.05, 0.01, 0.38, 0.085},
              {0.02, 0.04, 0.47, 0.080},
              {0.12, 0.09, 0.43, 0.070},
              {0.15, 0.12, 0.36, 0.060}}});
  solid.Add({{{0.00, -0.14, 0.15, 0.090},
              {0.06, -0.13, 0.27, 0.080},
              {0.14, -0.08, 0.35, 0.072},
              {0.23, -0.03, 0.38, 0.060}}});
  solid.Add({{{-0.24, 0.06, 0.28, 0.060}, {-0.23, 0.07, 0.38, 0.055}, {-0.22, 0.08, 0.47, 0.050}}});
  return solid;
}

SyntheticSolid Kidney() {
  SyntheticSolid solid(0.06);
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  solid.Add({{{0.10, 0, 0.33, 0.16},
              {-0.01, 0, 0.20, 0.20},
              {-0.05, 0, 0.00, 0.215},
              {-0.01, 0, -0.20, 0.205},
              {0.10, 0, -0.33, 0.165}},
             y,
             0.78});
  // The hilum, and the pelvis that leaves it downward.
  solid.Add({{{0.25, 0, 0.03, 0.13}}, y, 1.0, /*carve=*/true});
  solid.Add({{{0.08, 0, 0.03, 0.070},
              {0.17, 0, 0.03, 0.055},
              {0.24, 0, 0.01, 0.045},
              {0.30, 0, -0.04, 0.040}},
             y,
             1.0});
  return solid;
}

SyntheticSolid Stomach() {
  SyntheticSolid solid(0.05);
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  // Fundus, body, antrum, pylorus, and the first turn of the duodenum.
  solid.Add({{{0.17, 0, 0.29, 0.160},
              {0.21, 0, 0.12, 0.180},
              {0.18, 0, -0.07, 0.175},
              {0.08, 0, -0.23, 0.150},
              {-0.08, 0, -0.31, 0.120},
              {-0.22, 0, -0.28, 0.090},
              {-0.31, 0, -0.19, 0.058},
              {-0.37, 0, -0.09, 0.062},
              {-0.44, 0, -0.10, 0.060},
              {-0.47, 0, -0.20, 0.058}},
             y,
             0.85});
  // Oesophagus.
  solid.Add({{{0.08, 0, 0.22, 0.050},
              {0.00, 0, 0.32, 0.045},
              {-0.03, 0, 0.42, 0.043},
              {-0.03, 0, 0.50, 0.043}},
             y,
             1.0});
  return solid;
}

// Returns the thickness of the thinnest part, in the unit of the solid; the first mesh must not
// lose it.
double Thinnest(SyntheticShape shape) { return shape == SyntheticShape::kDolphin ? 0.014 : 0.03; }

PointCloud Plane(int vertices, double size) {
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(vertices))));
  PointCloud mesh;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      mesh.points.emplace_back(size * (static_cast<double>(column) / (side - 1) - 0.5),
                               size * (static_cast<double>(row) / (side - 1) - 0.5),
                               0.0);
    }
  }
  for (int row = 0; row + 1 < side; ++row) {
    for (int column = 0; column + 1 < side; ++column) {
      const int a = row * side + column;
      const int b = a + 1;
      const int c = b + side;
      const int d = a + side;
      // Alternating diagonals avoid a preferred direction.
      if ((row + column) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

}  // namespace

const std::vector<SyntheticShape>& AllSyntheticShapes() {
  static const std::vector<SyntheticShape> shapes = {SyntheticShape::kPlane,
                                                     SyntheticShape::kDolphin,
                                                     SyntheticShape::kHeart,
                                                     SyntheticShape::kKidney,
                                                     SyntheticShape::kStomach};
  return shapes;
}

const char* SyntheticShapeName(SyntheticShape shape) {
  switch (shape) {
    case SyntheticShape::kPlane:
      return "plane";
    case SyntheticShape::kDolphin:
      return "dolphin";
    case SyntheticShape::kHeart:
      return "heart";
    case SyntheticShape::kKidney:
      return "kidney";
    case SyntheticShape::kStomach:
      return "stomach";
  }
  LOG(FATAL) << "shape " << static_cast<int>(shape);
  return "";
}

std::optional<SyntheticShape> SyntheticShapeFromName(const std::string& name) {
  for (const SyntheticShape shape : AllSyntheticShapes()) {
    if (name == SyntheticShapeName(shape)) return shape;
  }
  return std::nullopt;
}

double DefaultSyntheticSize(SyntheticShape shape) {
  if (shape == SyntheticShape::kDolphin) return 1.0;
  return shape == SyntheticShape::kPlane ? 0.2 : 0.1;
}

SyntheticSolid MakeSyntheticSolid(SyntheticShape shape) {
  CHECK(shape != SyntheticShape::kPlane) << "a plane is no body";
  if (shape == SyntheticShape::kDolphin) return Dolphin();
  if (shape == SyntheticShape::kHeart) return Heart();
  return shape == SyntheticShape::kKidney ? Kidney() : Stomach();
}

PointCloud MakeSyntheticShape(SyntheticShape shape, int vertices, double size) {
  CHECK_GE(vertices, 500);
  CHECK_GT(size, 0.0);
  if (shape == SyntheticShape::kPlane) return Plane(vertices, size);
  const SyntheticSolid solid = MakeSyntheticSolid(shape);
  // Cells smaller than the thinnest part (by 1.5) preserve it; the edges of the final mesh are
  // about 1.5 / sqrt(count).
  const double cell = std::min(Thinnest(shape) / 1.5, 0.9 / std::sqrt(vertices));
  PointCloud mesh = RemeshUniformly(MarchTetrahedra(solid, cell), solid, vertices);
  for (Eigen::Vector3d& point : mesh.points) point *= size;
  return mesh;
}

}  // namespace ceres_ed
