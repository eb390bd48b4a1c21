#include "ceres_ed/slam/map/map_points.h"

#include <ceres_ed/util/random.h>

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kFloatStep = 0x1p-24;
constexpr double kNormalStep = 1.0 / 32767.0;

Eigen::Vector3d RandomVector(double size, Random* random) {
  return size * Eigen::Vector3d(random->Gaussian(), random->Gaussian(), random->Gaussian());
}

MapPoint RandomPoint(Random* random) {
  MapPoint point;
  point.position = RandomVector(1e4, random);
  point.normal = RandomVector(1.0, random).normalized();
  point.weight = 20.0 * random->Uniform();
  point.color = {1, 128, 255};
  point.id = 123456789;
  point.birth_frame = 98765;
  point.birth_position = RandomVector(30.0, random);
  point.contradictions = 4;
  point.sightings = 77;
  point.last_seen = 98770;
  return point;
}

TEST(MapPoints, KeepsPlacesToTheBitAndTheRestToTheirSteps) {
  Random random(1);
  MapPoints points(4);
  points.Resize(100);
  for (int slot = 0; slot < 100; ++slot) {
    const MapPoint in = RandomPoint(&random);
    points.Set(slot, in);
    const MapPoint out = points[slot];
    EXPECT_EQ(out.position, in.position);
    EXPECT_EQ(out.color, in.color);
    EXPECT_EQ(out.id, in.id);
    EXPECT_EQ(points.id(slot), in.id);
    EXPECT_EQ(out.birth_frame, in.birth_frame);
    EXPECT_EQ(out.contradictions, in.contradictions);
    EXPECT_EQ(out.sightings, in.sightings);
    EXPECT_EQ(out.last_seen, in.last_seen);
    EXPECT_LE((out.normal - in.normal).cwiseAbs().maxCoeff(), 0.5001 * kNormalStep);
    EXPECT_NEAR(out.weight, in.weight, kFloatStep * in.weight);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(
          out.birth_position[i], in.birth_position[i], kFloatStep * std::abs(in.birth_position[i]));
    }
    // A point that was stored once does not change when it is stored again.
    points.Set(slot, out);
    EXPECT_EQ(points[slot].normal, out.normal);
    EXPECT_EQ(points[slot].weight, out.weight);
  }
}

TEST(MapPoints, HoldsTheEndsOfItsRanges) {
  MapPoints points(1);
  points.Resize(3);
  MapPoint point;
  point.id = std::numeric_limits<int>::max();
  point.normal = -Eigen::Vector3d::UnitY();
  point.contradictions = 1000000;
  points.Set(1, point);
  EXPECT_EQ(points[1].normal, -Eigen::Vector3d::UnitY());
  EXPECT_EQ(points[1].contradictions, 32767);
  EXPECT_EQ(points.id(1), point.id);
  EXPECT_EQ(points.id(0), -1);
  points.Remove(1);
  EXPECT_EQ(points.id(1), -1);
  // A missing normal stays missing.
  point.normal.setZero();
  points.Set(2, point);
  EXPECT_EQ(points[2].normal, Eigen::Vector3d::Zero());
}

TEST(MapPoints, KeepsWeightsThatSumToOneInDouble) {
  Random random(2);
  for (int neighbors = 1; neighbors <= kMaxBoundNodes; ++neighbors) {
    MapPoints points(neighbors);
    points.Resize(neighbors);
    for (int slot = 0; slot < neighbors; ++slot) {
      const int size = slot + 1;
      std::vector<int> nodes(size);
      std::vector<double> weights(size);
      double sum = 0.0;
      for (int i = 0; i < size; ++i) {
        nodes[i] = 1000 * slot + i;
        sum += weights[i] = 0.1 + random.Uniform();
      }
      for (double& weight : weights) weight /= sum;
      std::sort(weights.rbegin(), weights.rend());
      points.Bind(slot, {nodes.data(), weights.data(), size});
      const PointBinding out = points.binding(slot);
      ASSERT_EQ(out.size, size);
      double total = 0.0;
      for (int i = size - 1; i > 0; --i) {
        EXPECT_EQ(out.weights[i], static_cast<double>(static_cast<float>(weights[i])));
        total += out.weights[i];
      }
      EXPECT_NEAR(total + out.weights[0], 1.0, 1e-15);
      EXPECT_TRUE(std::equal(nodes.begin(), nodes.end(), out.nodes));
      // Rounding a binding before it is stored gives the stored binding.
      const PointBinding kept = MapPoints::Kept({nodes.data(), weights.data(), size});
      EXPECT_TRUE(std::equal(out.weights, out.weights + size, kept.weights));
    }
  }
}

TEST(MapPoints, TakesLessThanAHundredBytesAPoint) {
  MapPoints points(4);
  points.Resize(100000);
  EXPECT_LT(points.PointHeapBytes() + points.BindingHeapBytes(), 93u * 100000);
  EXPECT_GE(points.PointHeapBytes() + points.BindingHeapBytes(), 92u * 100000);
}

TEST(MapPointsDeathTest, RefusesABindingOfTooManyNodes) {
  MapPoints points(1);
  points.Resize(1);
  const int nodes[] = {0, 1};
  const double weights[] = {0.5, 0.5};
  EXPECT_DEATH(points.Bind(0, {nodes, weights, 2}), "binding of 2");
}

}  // namespace
}  // namespace ceres_ed
