#include "ceres_ed/simulation/pairs.h"

#include <ceres_ed/geometry/triangle_area.h>
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/views.h>

#include <algorithm>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// How to make one pair.
struct Recipe {
  const char* name;
  SyntheticShape shape;
  int source_vertices;
  // The number of vertices of the whole target, before the view is applied.
  int target_vertices;
  std::uint64_t seed;
  bool is_partial;
  // The position of the camera as a multiple of the size, in the frame of the source.
  double eye[3];
  // The rigid motion: a rotation vector in degrees, and a translation as a share of the size.
  double rotation_deg[3];
  double translation[3];
};

// The noise on partial targets (seen from the front), as a share of the size. It is the noise of a
// good stereo reconstruction.
constexpr double kNoiseShare = 0.0005;
constexpr Recipe kRecipes[] = {
    {"plane_bumps", SyntheticShape::kPlane, 2500, 3481, 1, false, {}, {}, {}},
    {"dolphin_bend", SyntheticShape::kDolphin, 3000, 3600, 2, false, {}, {}, {}},
    {"heart_partial",
     SyntheticShape::kHeart,
     2800,
     4400,
     3,
     true,
     {-0.25, -1.1, 0.1},
     {2.0, -3.0, 2.5},
     {0.030, -0.020, 0.025}},
    {"kidney_partial",
     SyntheticShape::kKidney,
     2400,
     3800,
     4,
     true,
     {-0.5, -1.1, 0.3},
     {-2.5, 2.0, 3.0},
     {-0.020, 0.030, 0.030}},
    {"stomach_partial",
     SyntheticShape::kStomach,
     2600,
     4000,
     5,
     true,
     {0.3, -1.2, -0.4},
     {3.0, 2.5, -2.0},
     {0.025, 0.025, -0.020}}};

Similarity RigidMotion(const Recipe& recipe, double size) {
  constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
  const Eigen::Vector3d turn = kRadiansPerDegree * Eigen::Vector3d(recipe.rotation_deg);
  Similarity motion;
  if (turn.norm() > 0.0) {
    motion.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized());
  }
  motion.translation = size * Eigen::Vector3d(recipe.translation);
  return motion;
}

void Move(const Similarity& motion, PointCloud* cloud) {
  for (Eigen::Vector3d& point : cloud->points) point = motion * point;
}

// Adds the tips of the beak, of the dorsal fin and of both halves of the fluke as handles. Each
// handle contains the vertices near the tip, because one vertex alone does not determine the
// rotation of the handle.
void AddHandles(SyntheticPair* pair) {
  constexpr double kReach = 0.022;
  const std::vector<Eigen::Vector3d> directions = {
      {1.0, 0.0, 0.0}, {-0.3, 0.0, 1.0}, {-1.0, 1.0, 0.0}, {-1.0, -1.0, 0.0}};
  const auto& points = pair->source.points;
  for (const Eigen::Vector3d& direction : directions) {
    const auto tip =
        std::max_element(points.begin(), points.end(), [&direction](const auto& a, const auto& b) {
          return direction.dot(a) < direction.dot(b);
        });
    for (std::size_t k = 0; k < points.size(); ++k) {
      if ((points[k] - *tip).norm() > kReach * pair->size) continue;
      pair->landmarks.emplace_back(static_cast<int>(k), pair->truth.points[k]);
    }
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if ((points[k] - pair->truth.points[k]).norm() < 1e-9 * pair->size) {
      pair->fixed.push_back(static_cast<int>(k));
    }
  }
}

SyntheticPair Make(const Recipe& recipe) {
  SyntheticPair pair;
  pair.name = recipe.name;
  pair.shape = recipe.shape;
  pair.size = DefaultSyntheticSize(recipe.shape);
  pair.seed = recipe.seed;
  pair.target_from_source = RigidMotion(recipe, pair.size);
  pair.source = MakeSyntheticShape(recipe.shape, recipe.source_vertices, pair.size);
  pair.truth = DeformSyntheticShape(recipe.shape, pair.size, 1.0, pair.source);
  const PointCloud whole =
      DeformSyntheticShape(recipe.shape,
                           pair.size,
                           1.0,
                           MakeSyntheticShape(recipe.shape, recipe.target_vertices, pair.size));
  pair.target = whole;
  if (recipe.is_partial) {
    SyntheticView view;
    view.eye = pair.size * Eigen::Vector3d(recipe.eye);
    pair.target = VisiblePart(whole, view);
    pair.overlap = SurfaceArea(pair.target.points, pair.target.triangles) /
                   SurfaceArea(whole.points, whole.triangles);
    const std::vector<char> visible = VisibleVertices(pair.truth, view);
    for (std::size_t k = 0; k < visible.size(); ++k) {
      if (visible[k]) pair.visible.push_back(static_cast<int>(k));
    }
    pair.noise = kNoiseShare * pair.size;
    AddSyntheticNoise(pair.noise, pair.seed, &pair.target);
  }
  Move(pair.target_from_source, &pair.target);
  Move(pair.target_from_source, &pair.truth);
  if (recipe.shape == SyntheticShape::kDolphin) AddHandles(&pair);
  return pair;
}

}  // namespace

std::vector<std::string> SyntheticPairNames() {
  std::vector<std::string> names;
  for (const Recipe& recipe : kRecipes) names.emplace_back(recipe.name);
  return names;
}

SyntheticPair MakeSyntheticPair(const std::string& name) {
  for (const Recipe& recipe : kRecipes) {
    if (name == recipe.name) return Make(recipe);
  }
  LOG(FATAL) << "no pair '" << name << "'";
  return {};
}

}  // namespace ceres_ed
