#include "ceres_ed/registration/intrinsic/map_search.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// The number of eigenfunctions, beside the constant one, whose signs are tried.
constexpr int kSigns = 6;
// Eigenvalues that differ by less than this factor are taken as possibly equal.
constexpr double kNearlyEqual = 1.25;
// At most this many pairs of eigenfunctions are rotated.
constexpr int kMaxRotated = 2;
// The numbers of source and target rows of the first trials.
constexpr int kTrialRows = 150;
constexpr int kTrialTargetRows = 400;
// This many maps are refined up to kFirstSize eigenfunctions, with these numbers of rows.
constexpr int kFewRows = 150;
constexpr int kFewTargetRows = 400;
constexpr int kRefined = 40;
constexpr int kFirstSize = 21;
constexpr int kFirstStep = 2;
constexpr int kLastStep = 7;
// Maps whose cost is more than this times that of the best one are not refined to the end.
constexpr double kMaxCostRatio = 1.6;
// Two maps are equal if this share of their images are nearer to each other than this part of the
// target's diagonal.
constexpr double kSameShare = 0.92;
constexpr double kNear = 0.06;

std::vector<int> Prefix(const std::vector<int>& order, int count) {
  return {order.begin(), order.begin() + std::min<std::ptrdiff_t>(count, order.size())};
}

// Returns the first of each of the pairs of neighbouring eigenfunctions that may be rotated,
// without overlaps, the closest pairs first.
std::vector<int> RotatedPairs(const MapSearchInput& input, int size) {
  std::vector<std::pair<double, int>> ratios;
  for (int k = 1; k + 1 < size; ++k) {
    const auto ratio = [k](const SpectralBasis& basis) {
      return basis.eigenvalues[k + 1] / std::max(basis.eigenvalues[k], 1e-9);
    };
    const double least = std::min(ratio(*input.source), ratio(*input.target));
    if (least < kNearlyEqual) ratios.emplace_back(least, k);
  }
  std::sort(ratios.begin(), ratios.end());
  std::vector<int> pairs;
  for (const auto& [ratio, k] : ratios) {
    const bool is_free = std::none_of(
        pairs.begin(), pairs.end(), [k = k](int other) { return std::abs(other - k) < 2; });
    if (is_free && static_cast<int>(pairs.size()) < kMaxRotated) pairs.push_back(k);
  }
  return pairs;
}

// Returns all functional maps that are tried: signs, and rotations of some pairs. A rotation by 90
// degrees with all signs covers all multiples of it.
std::vector<Eigen::MatrixXd> Trials(const MapSearchInput& input, int size) {
  const std::vector<int> pairs = RotatedPairs(input, size);
  constexpr int kAngles = 4;
  int rotations = 1;
  for (std::size_t i = 0; i < pairs.size(); ++i) rotations *= kAngles;
  std::vector<Eigen::MatrixXd> trials;
  for (int rotation = 0; rotation < rotations; ++rotation) {
    Eigen::MatrixXd rotated = Eigen::MatrixXd::Identity(size, size);
    int rest = rotation;
    for (const int k : pairs) {
      const double angle = (rest % kAngles) * M_PI / 4.0;
      rest /= kAngles;
      rotated.block<2, 2>(k, k) << std::cos(angle), -std::sin(angle), std::sin(angle),
          std::cos(angle);
    }
    // Rotations by 90 and 135 degrees differ from those by 0 and 45 in the order of the functions.
    for (int signs = 0; signs < (1 << (size - 1)); ++signs) {
      Eigen::MatrixXd trial = rotated;
      for (int k = 1; k < size; ++k) {
        if ((signs >> (k - 1)) & 1) trial.row(k) *= -1.0;
      }
      trials.push_back(std::move(trial));
    }
  }
  return trials;
}

// Returns the mean difference between the signatures of source vertices and of their images, and of
// target vertices and theirs.
double SignatureDifference(const MapSearchInput& input,
                           const SpectralPair& pair,
                           const PointMap& map) {
  const Eigen::MatrixXd& source = *input.source_signature;
  const Eigen::MatrixXd& target = *input.target_signature;
  double sum = 0.0;
  for (std::size_t i = 0; i < map.forth.size(); ++i) {
    sum += (source.row(pair.source_rows[i]) - target.row(map.forth[i])).cwiseAbs().mean();
  }
  for (std::size_t i = 0; i < map.back.size(); ++i) {
    sum += (source.row(map.back[i]) - target.row(pair.target_rows[i])).cwiseAbs().mean();
  }
  return sum / (map.forth.size() + map.back.size());
}

void KeepBest(std::size_t count, std::vector<RankedMap>* maps) {
  std::stable_sort(maps->begin(), maps->end(), [](const RankedMap& a, const RankedMap& b) {
    return a.cost < b.cost;
  });
  if (maps->size() > count) maps->resize(count);
}

// Leaves out maps that are equal to better ones, to which different trials may lead. Maps that swap
// one pair of limbs differ in the images of few points, so few may differ.
void RemoveEqual(const std::vector<Eigen::Vector3d>& places, std::vector<RankedMap>* maps) {
  const double near = kNear * BoundingBox(places).diagonal().norm();
  std::vector<RankedMap> kept;
  for (RankedMap& map : *maps) {
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const RankedMap& other) {
      std::size_t same = 0;
      for (std::size_t i = 0; i < map.map.forth.size(); ++i) {
        same += (places[map.map.forth[i]] - places[other.map.forth[i]]).norm() < near;
      }
      return same > kSameShare * map.map.forth.size();
    });
    if (!is_known) kept.push_back(std::move(map));
  }
  *maps = std::move(kept);
}

}  // namespace

std::vector<RankedMap> SearchMaps(const MapSearchInput& input, int count) {
  const SpectralPair whole = {input.source, input.target, input.source_order, input.target_order};
  const int most = whole.size();
  const int size = std::min(kSigns + 1, most);
  const auto stopped = [&] { return input.should_stop && input.should_stop(); };
  const SpectralPair trial_pair = {input.source,
                                   input.target,
                                   Prefix(input.source_order, kTrialRows),
                                   Prefix(input.target_order, kTrialTargetRows)};
  std::vector<RankedMap> maps;
  for (const Eigen::MatrixXd& trial : Trials(input, size)) {
    if (stopped()) return {};
    RankedMap map;
    map.map = ZoomOut(trial_pair, PointMapOf(trial_pair, trial), size, size, 1);
    map.cost = SignatureDifference(input, trial_pair, map.map);
    maps.push_back(std::move(map));
  }
  KeepBest(kRefined, &maps);
  const SpectralPair pair = {input.source,
                             input.target,
                             Prefix(input.source_order, kFewRows),
                             Prefix(input.target_order, kFewTargetRows)};
  for (RankedMap& map : maps) {
    if (stopped()) return {};
    map.map = PointMapOf(pair, FunctionalMap(trial_pair, map.map, size));
    map.map = ZoomOut(pair, std::move(map.map), size, kFirstSize, kFirstStep);
    map.cost = SignatureDifference(input, pair, map.map);
  }
  KeepBest(maps.size(), &maps);
  RemoveEqual(*input.target_points, &maps);
  KeepBest(count, &maps);
  while (maps.size() > 2 && maps.back().cost > kMaxCostRatio * maps.front().cost) maps.pop_back();
  // The best maps are refined with more points.
  for (RankedMap& map : maps) {
    if (stopped()) return {};
    const Eigen::MatrixXd C = FunctionalMap(pair, map.map, std::min(kFirstSize, most));
    map.map = ZoomOut(whole, PointMapOf(whole, C), kFirstSize + kLastStep, most, kLastStep);
    map.cost = SignatureDifference(input, whole, map.map);
  }
  KeepBest(maps.size(), &maps);
  return maps;
}

}  // namespace ceres_ed
