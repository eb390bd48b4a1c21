#include "ceres_ed/slam/frame/foreground.h"

#include <ceres_ed/geometry/nearest_pixel.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace ceres_ed {
namespace {

// Lengths are in map units. The least distance before the map; the least jump of the depth between
// two cells; and the reach of a map point.
constexpr double kBefore = 0.5;
constexpr double kJump = 0.3;
constexpr double kReach = 0.3;
// Noise makes all three larger, in deviations.
constexpr double kNoiseWidth = 4.0;
// The same surface is in the next frame within this distance, and stands still within this one.
constexpr double kSameSurface = 1.0;
constexpr double kStandsStill = 0.2;
// The number of frames after which what stands still is a part of the scene.
constexpr int kSettledAge = 20;
// The least number of cells of a part, and the least share of them that must lie before the map or
// have been foreground before.
constexpr int kFewestCells = 30;
constexpr double kLeastEvidence = 0.25;
// The least share of the border at which the depth jumps to what is behind.
constexpr double kLeastJumps = 0.7;
// Parts that come in at the border of the first picture are foreground if they are smaller than
// this share of the surface.
constexpr double kLargestAtStart = 0.2;

enum class Place : std::uint8_t { kNone, kOnMap, kBeforeMap, kUnknown };

constexpr std::array<std::array<int, 2>, 4> kNeighbors = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

// Returns the depth of the map at each cell; infinity where there is no map.
Image<double> MapDepth(const std::vector<VisiblePoint>& visible, const ObservedSurface& surface) {
  Image<double> depth(surface.width(), surface.height(), std::numeric_limits<double>::infinity());
  const int cell = surface.cell();
  const int middle = cell / 2;  // the pixel of a cell that its depth belongs to
  const double f = std::max(surface.camera().fx, surface.camera().fy);
  for (const VisiblePoint& point : visible) {
    const double radius = kReach * f / point.in_camera.z() / cell;
    const double ci = (point.pixel.x() - middle) / cell;
    const double cj = (point.pixel.y() - middle) / cell;
    const int i_end = std::min(depth.width() - 1, static_cast<int>(std::floor(ci + radius)));
    const int j_end = std::min(depth.height() - 1, static_cast<int>(std::floor(cj + radius)));
    for (int j = std::max(0, static_cast<int>(std::ceil(cj - radius))); j <= j_end; ++j) {
      for (int i = std::max(0, static_cast<int>(std::ceil(ci - radius))); i <= i_end; ++i) {
        depth(i, j) = std::min(depth(i, j), point.in_camera.z());
      }
    }
  }
  return depth;
}

// Returns where each cell of the surface lies with respect to the map.
Image<Place> PlacesOf(const std::vector<VisiblePoint>& visible,
                      const ObservedSurface& surface,
                      double noise) {
  const Image<double> map = MapDepth(visible, surface);
  Image<Place> places(surface.width(), surface.height(), Place::kNone);
  for (int j = 0; j < surface.height(); ++j) {
    for (int i = 0; i < surface.width(); ++i) {
      const SurfacePatch& patch = surface.patch(i, j);
      if (!patch.valid()) continue;
      const double before = map(i, j) - patch.point.z();
      if (!(std::abs(before) < std::numeric_limits<double>::infinity())) {
        places(i, j) = Place::kUnknown;
      } else if (before > kBefore + noise) {
        places(i, j) = Place::kBeforeMap;
      } else {
        places(i, j) = before < -(kBefore + noise) ? Place::kUnknown : Place::kOnMap;
      }
    }
  }
  return places;
}

// A connected part of the surface that does not lie on the map.
struct Part {
  std::vector<std::pair<int, int>> cells;
  // The number of cells before the map.
  int before_map = 0;
  // The neighbours at the border that are far behind, and those to which the surface goes on or
  // which lie before it.
  int jumps = 0;
  int others = 0;
  bool at_picture_border = false;

  bool HasJumps() const { return jumps > 0 && jumps >= kLeastJumps * (jumps + others); }
};

// Divides the surface beside the map into parts.
class PartCollector {
 public:
  PartCollector(const ObservedSurface& surface, const Image<Place>& places, double jump)
      : surface_(surface),
        places_(places),
        jump_(jump),
        visited_(surface.width(), surface.height(), 0) {}

  // Returns whether a cell belongs to a part that was not collected yet.
  bool IsNew(int i, int j) const { return IsOpen(i, j) && visited_(i, j) == 0; }

  // Returns the part of cell (i, j), which must be new.
  Part Collect(int i, int j) {
    Part part;
    part.cells.emplace_back(i, j);
    visited_(i, j) = 1;
    // The list grows while it is visited.
    for (std::size_t k = 0; k < part.cells.size(); ++k) Visit(part.cells[k], &part);
    return part;
  }

 private:
  bool IsOpen(int i, int j) const {
    return places_(i, j) == Place::kBeforeMap || places_(i, j) == Place::kUnknown;
  }

  void Visit(std::pair<int, int> cell, Part* part) {
    const auto [i, j] = cell;
    if (places_(i, j) == Place::kBeforeMap) ++part->before_map;
    const double z = surface_.patch(i, j).point.z();
    for (const auto& [di, dj] : kNeighbors) {
      const int ni = i + di;
      const int nj = j + dj;
      if (!places_.Contains(ni, nj)) {
        part->at_picture_border = true;
        continue;
      }
      const SurfacePatch& next = surface_.patch(ni, nj);
      // What was not measured is evidence for neither.
      if (!next.valid()) continue;
      const double behind = next.point.z() - z;
      if (behind > jump_) {
        ++part->jumps;
      } else if (behind < -jump_ || !IsOpen(ni, nj)) {
        ++part->others;
      } else if (visited_(ni, nj) == 0) {
        visited_(ni, nj) = 1;
        part->cells.emplace_back(ni, nj);
      }
    }
  }

  const ObservedSurface& surface_;
  const Image<Place>& places_;
  double jump_;
  Image<std::uint8_t> visited_;
};

}  // namespace

// Returns what the last frame knows of the surface of a valid patch: if it was not foreground, or
// was elsewhere, its age is -1.
Foreground::Cell Foreground::Continue(const CameraPose& camera_from_map,
                                      const SurfacePatch& patch) const {
  Cell cell;
  if (cells_.empty()) return cell;
  const Eigen::Vector3d place = camera_from_map.ApplyInverse(patch.point);
  const Eigen::Vector3d before = camera_from_map_ * place;
  if (!(before.z() > 0.0)) return cell;
  const Eigen::Vector2d pixel = camera_.Project(before);
  if (!InPicture(camera_, pixel)) return cell;
  const int at = cell_at_(NearestPixel(pixel.x()) / cell_, NearestPixel(pixel.y()) / cell_);
  if (at == kNoCell) return cell;
  const Cell& last = cells_[at];
  if ((last.now - place).norm() > kSameSurface) return cell;
  cell.age = last.age + 1;
  cell.place = last.place;
  if (std::abs((camera_from_map * last.place).z() - patch.point.z()) > kStandsStill) {
    cell.age = 0;
    cell.place = place;
  }
  return cell;
}

double Foreground::Remove(const std::vector<VisiblePoint>& visible,
                          const CameraPose& camera_from_map,
                          ObservedSurface* surface) {
  const double noise = kNoiseWidth * surface->noise();
  const bool first = visible.empty() && cell_at_.empty();
  const Image<Place> places = PlacesOf(visible, *surface, noise);
  const auto on_map = std::count(places.pixels().begin(), places.pixels().end(), Place::kOnMap);
  PartCollector parts(*surface, places, kJump + noise);
  std::vector<Cell> removed;
  for (int v = 0; v < surface->height(); ++v) {
    for (int u = 0; u < surface->width(); ++u) {
      if (!parts.IsNew(u, v)) continue;
      const Part part = parts.Collect(u, v);
      const auto size = static_cast<double>(part.cells.size());
      if (size < kFewestCells || !part.HasJumps()) continue;
      std::vector<Cell> known;
      known.reserve(part.cells.size());
      for (const auto& [i, j] : part.cells) {
        known.push_back(Continue(camera_from_map, surface->patch(i, j)));
      }
      // Is there evidence that it is foreground?
      const auto continued = std::count_if(
          known.begin(), known.end(), [](const Cell& cell) { return cell.in_foreground(); });
      const bool is_foreground =
          first ? part.at_picture_border && size <= kLargestAtStart * surface->num_valid()
                : part.before_map <= on_map &&
                      std::max<double>(part.before_map, continued) >= kLeastEvidence * size;
      if (!is_foreground) continue;
      // Has it stood still for long?
      std::vector<double> ages;
      ages.reserve(part.cells.size());
      for (std::size_t k = 0; k < known.size(); ++k) {
        const auto& [i, j] = part.cells[k];
        Cell& cell = known[k];
        cell.at = j * surface->width() + i;
        cell.now = camera_from_map.ApplyInverse(surface->patch(i, j).point);
        if (!cell.in_foreground()) {
          cell.age = 0;
          cell.place = cell.now;
        }
        ages.push_back(cell.age);
      }
      if (Median(std::move(ages)) >= kSettledAge) continue;
      removed.insert(removed.end(), known.begin(), known.end());
    }
  }
  const double share = static_cast<double>(removed.size()) / std::max(1, surface->num_valid());
  for (const Cell& cell : removed) {
    surface->Remove(cell.at % surface->width(), cell.at / surface->width());
  }
  SetCells(surface->width(), surface->height(), std::move(removed));
  cell_ = surface->cell();
  camera_from_map_ = camera_from_map;
  return share;
}

void Foreground::SetCells(int width, int height, std::vector<Cell> cells) {
  if (cell_at_.width() != width || cell_at_.height() != height) {
    cell_at_ = Image<int>(width, height, kNoCell);
  } else {
    for (const Cell& cell : cells_) cell_at_.pixels()[cell.at] = kNoCell;
  }
  cells_ = std::move(cells);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    cell_at_.pixels()[cells_[c].at] = static_cast<int>(c);
  }
}

MaskImage Foreground::Mask() const {
  if (cell_at_.empty()) return {};
  MaskImage mask(camera_.width, camera_.height, 0);
  for (int v = 0; v < mask.height(); ++v) {
    for (int u = 0; u < mask.width(); ++u) {
      mask(u, v) = cell_at_(u / cell_, v / cell_) != kNoCell ? 1 : 0;
    }
  }
  return mask;
}

}  // namespace ceres_ed
