#include "ceres_ed/geometry/polygon_triangles.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

// The time to cut ears off grows with the square of the number of corners.
constexpr std::size_t kMostCorners = 256;
// Corners that turn by less than this part of the area of the polygon are straight.
constexpr double kStraight = 1e-9;

// Returns the normal of the polygon, as long as twice its area (Newell).
Eigen::Vector3d AreaNormal(const Corners& corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    normal += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  }
  return normal;
}

// The corners that are left of a polygon, and tests seen along its normal.
class Ring {
 public:
  explicit Ring(const Corners& corners) : corners_(corners), left_(corners.size()) {
    std::iota(left_.begin(), left_.end(), 0);
    const Eigen::Vector3d normal = AreaNormal(corners);
    area_ = normal.norm();
    normal_ = area_ > 0.0 ? Eigen::Vector3d(normal / area_) : Eigen::Vector3d::Zero();
  }

  std::size_t size() const { return left_.size(); }
  void Remove(std::size_t i) { left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i)); }

  // Returns the corner at `i` with the one before and the one behind it.
  std::array<int, 3> Triangle(std::size_t i) const {
    return {left_[(i + size() - 1) % size()], left_[i], left_[(i + 1) % size()]};
  }

  bool IsConvex() const {
    for (std::size_t i = 0; i < size(); ++i) {
      if (Turn(Triangle(i)) < -kStraight * area_) return false;
    }
    return true;
  }

  // Returns how near the triangle at `i` is to an equilateral one (twice its area by the sum of its
  // squared sides), or 0 if it cannot be cut off. Corners that lie outside of it by less than this
  // part of its size count as inside.
  double EarQuality(std::size_t i, double margin) const {
    const std::array<int, 3> ear = Triangle(i);
    const double turn = Turn(ear);
    if (!(turn > kStraight * area_)) return 0.0;
    const bool is_blocked = std::any_of(left_.begin(), left_.end(), [&](int other) {
      if (std::find(ear.begin(), ear.end(), other) != ear.end()) return false;
      const double least = -margin * turn;
      return Turn({ear[0], ear[1], other}) >= least && Turn({ear[1], ear[2], other}) >= least &&
             Turn({ear[2], ear[0], other}) >= least;
    });
    if (is_blocked) return 0.0;
    return turn / ((corners_[ear[1]] - corners_[ear[0]]).squaredNorm() +
                   (corners_[ear[2]] - corners_[ear[1]]).squaredNorm() +
                   (corners_[ear[0]] - corners_[ear[2]]).squaredNorm());
  }

 private:
  // Returns twice the area of a triangle, which is negative if it turns against the polygon.
  double Turn(const std::array<int, 3>& t) const {
    return (corners_[t[1]] - corners_[t[0]]).cross(corners_[t[2]] - corners_[t[0]]).dot(normal_);
  }

  const Corners& corners_;
  std::vector<int> left_;
  Eigen::Vector3d normal_;
  double area_ = 0.0;
};

void AppendFan(const Ring& ring, std::vector<std::array<int, 3>>* triangles) {
  const int apex = ring.Triangle(0)[1];
  for (std::size_t i = 2; i < ring.size(); ++i) {
    const std::array<int, 3> last = ring.Triangle(i);
    triangles->push_back({apex, last[0], last[1]});
  }
}

// Cuts off one ear after the other, the best one first, until three corners or no ears are left.
// Ears whose side passes close by another corner would leave a polygon that touches itself, so they
// are cut only if there are no others.
void CutEars(Ring* ring, std::vector<std::array<int, 3>>* triangles) {
  constexpr double kMargin = 0.02;
  std::vector<double> quality;
  const auto best_ear = [&] { return std::max_element(quality.begin(), quality.end()); };
  const auto judge_all = [&](double margin) {
    quality.resize(ring->size());
    for (std::size_t i = 0; i < ring->size(); ++i) quality[i] = ring->EarQuality(i, margin);
  };
  judge_all(kMargin);
  while (ring->size() > 3) {
    // A cut changes the neighbours; others only if the corner that is gone lay near their sides.
    if (!(*best_ear() > 0.0)) judge_all(kMargin);
    if (!(*best_ear() > 0.0)) judge_all(0.0);
    const auto best = best_ear();
    if (!(*best > 0.0)) return;
    const auto i = static_cast<std::size_t>(best - quality.begin());
    triangles->push_back(ring->Triangle(i));
    ring->Remove(i);
    quality.erase(best);
    for (const std::size_t near : {i % ring->size(), (i + ring->size() - 1) % ring->size()}) {
      quality[near] = ring->EarQuality(near, kMargin);
    }
  }
}

}  // namespace

std::vector<std::array<int, 3>> PolygonTriangles(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<std::array<int, 3>> triangles;
  if (corners.size() < 3) return triangles;
  Ring ring(corners);
  if (corners.size() <= kMostCorners && !ring.IsConvex()) CutEars(&ring, &triangles);
  AppendFan(ring, &triangles);
  return triangles;
}

}  // namespace ceres_ed
