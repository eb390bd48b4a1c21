#include "ceres_ed/io/sequence/depth_sequence.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

constexpr double kNearest = 1e-3;
constexpr double kFarthest = 100.0;
// Depth that is stored as whole numbers has finer steps than this, in metres.
constexpr double kCoarsestStep = 0.02;

// The units in which cameras and programs store depth; the ones that are met most come first.
struct StoredUnit {
  double per_metre;
  const char* name;
};
constexpr StoredUnit kStoredUnits[] = {{1e3, "millimetres"},
                                       {1.0, "metres"},
                                       {1e6, "micrometres"},
                                       {1e4, "tenths of a millimetre"},
                                       {1e2, "centimetres"}};

std::string Text(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

// Returns the depths that were measured, in metres.
std::vector<float> Measured(const DepthImage& depth) {
  std::vector<float> measured;
  measured.reserve(depth.pixels().size());
  std::copy_if(
      depth.pixels().begin(), depth.pixels().end(), std::back_inserter(measured), [](float value) {
        return value > 0.0F;
      });
  return measured;
}

// Returns what is strange about a scene whose median depth is `median` metres, or nothing.
std::string StrangeDistance(double median) {
  if (median >= kNearest && median <= kFarthest) return "";
  return "the scene is " + Text(median) + " m away, " +
         (median < kNearest ? "nearer than 1 mm" : "farther than 100 m");
}

// Returns whether the depths differ and are all whole numbers of stored units, as those of 16-bit
// pictures are. Depth is kept as float, so large numbers are rounded.
bool AreWhole(const std::vector<float>& measured, double units_per_metre) {
  const auto is_whole = [&](float value) {
    const double stored = value * units_per_metre;
    return std::abs(stored - std::round(stored)) <= 1e-6 * std::max(1.0, stored);
  };
  const auto differs = [&](float value) { return value != measured.front(); };
  return std::any_of(measured.begin(), measured.end(), differs) &&
         std::all_of(measured.begin(), measured.end(), is_whole);
}

// Returns which number of units, other than `given`, would place a scene whose median is `stored`
// units at a distance at which a camera sees a body or a room, or nothing if none does.
std::string ProposedUnit(double stored, double given) {
  constexpr double kNear = 0.02, kFar = 10.0;
  for (const StoredUnit& unit : kStoredUnits) {
    const double distance = stored / unit.per_metre;
    if (unit.per_metre == given || distance < kNear || distance > kFar) continue;
    return " With depth_units_per_metre=" + Text(unit.per_metre) + " (" + unit.name +
           ") it would be " + Text(distance) + " m away.";
  }
  return "";
}

}  // namespace

std::string DepthRangeWarning(const DepthImage& depth, double depth_units_per_metre) {
  const std::vector<float> measured = Measured(depth);
  if (measured.empty()) return "";
  const double median = Median(measured);
  std::string strange = StrangeDistance(median);
  const double step = 1.0 / depth_units_per_metre;
  if (strange.empty() && step > kCoarsestStep && AreWhole(measured, depth_units_per_metre)) {
    strange = "the scene is " + Text(median) + " m away and measured in steps of " + Text(step) +
              " m, coarser than depth cameras have";
  }
  if (strange.empty()) return "";
  return strange + ": is the depth really stored as " + Text(depth_units_per_metre) +
         " units per metre?" + ProposedUnit(median * depth_units_per_metre, depth_units_per_metre);
}

std::string StereoRangeWarning(const DepthImage& depth, double baseline) {
  std::vector<float> measured = Measured(depth);
  if (measured.empty()) return "";
  const std::string strange = StrangeDistance(Median(std::move(measured)));
  if (strange.empty()) return "";
  return strange + ": are the cameras really " + Text(baseline) + " m apart?";
}

}  // namespace ceres_ed
