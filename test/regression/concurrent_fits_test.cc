// Several fits and trackers at once, each in a thread of its own with helpers of its own: the bytes
// are those of one after the other. Built with the thread sanitizer too, which has to stay silent.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/slam.h>

#include <cstring>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <test/slam/bumpy_sequence.h>

namespace ceres_ed {
namespace {

// A body and the same one bent.
struct Pair {
  explicit Pair(SyntheticShape shape)
      : source(MakeSyntheticShape(shape, 500, 1.0)),
        target(DeformSyntheticShape(shape, 1.0, 0.4, MakeSyntheticShape(shape, 700, 1.0))) {}

  PointCloud source;
  PointCloud target;
};

using Points = std::vector<Eigen::Vector3d>;

FitOptions TwoThreads(SolveMode mode) {
  FitOptions options;
  options.strategy.mode = mode;
  options.num_threads = 2;
  return options;
}

Points FitPair(const Pair& pair, SolveMode mode) {
  const EnergyRegistry registry = BuiltinEnergies();
  FitInput input;
  input.source = pair.source;
  input.target = pair.target;
  const StatusOr<FitResult> fit = Fit(input, TwoThreads(mode), registry);
  return fit.ok() && fit->IsUsable() ? fit->points : Points();
}

// All node positions after a few frames.
Points Track(int first_frame) {
  const EnergyRegistry registry = BuiltinEnergies();
  SlamOptions options;
  options.nodes_in_view = 40;
  options.num_threads = 2;
  auto slam = DeformableSlam::Create(BumpyCamera(), options, registry);
  if (!slam.ok()) return {};
  const BumpyScene scene;
  for (int frame = first_frame; frame < first_frame + 3; ++frame) {
    const DepthImage depth = scene.RenderDepth(frame);
    const ColorImage color = scene.RenderColor(frame);
    SlamFrame input;
    input.number = frame;
    input.depth = &depth;
    input.color = &color;
    (*slam)->Process(input);
  }
  Points points;
  const DeformableMap& map = (*slam)->map();
  for (int j = 0; j < map.graph().num_nodes(); ++j) {
    points.push_back(map.graph().position(j) + NodeTranslation(map.state().node(j)));
  }
  return points;
}

void ExpectSameBytes(const std::vector<Points>& one, const std::vector<Points>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    ASSERT_FALSE(one[k].empty()) << k;
    ASSERT_EQ(one[k].size(), other[k].size()) << k;
    EXPECT_EQ(std::memcmp(one[k].data(), other[k].data(), one[k].size() * sizeof(one[k][0])), 0)
        << k;
  }
}

// Runs the tasks one after the other, then all at once, and compares.
void ExpectAlike(const std::vector<std::function<Points()>>& tasks) {
  std::vector<Points> in_turn;
  for (const auto& task : tasks) in_turn.push_back(task());
  std::vector<Points> at_once(tasks.size());
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    threads.emplace_back([&, k] { at_once[k] = tasks[k](); });
  }
  for (std::thread& thread : threads) thread.join();
  ExpectSameBytes(in_turn, at_once);
}

TEST(Concurrent, FitsGiveTheBytesOfOneAfterTheOther) {
  const Pair dolphin(SyntheticShape::kDolphin);
  const Pair heart(SyntheticShape::kHeart);
  ExpectAlike({[&] { return FitPair(dolphin, SolveMode::kBatch); },
               [&] { return FitPair(heart, SolveMode::kTwoLevel); }});
}

TEST(Concurrent, FitsOfOneFitterGiveTheBytesOfOneAfterTheOther) {
  const Pair dolphin(SyntheticShape::kDolphin);
  PointCloud further = dolphin.target;
  for (Eigen::Vector3d& point : further.points) point.x() += 0.05 * point.y();
  const EnergyRegistry registry = BuiltinEnergies();
  const auto fitter =
      SurfaceFitter::Create(dolphin.source, TwoThreads(SolveMode::kBatch), registry);
  ASSERT_TRUE(fitter.ok()) << fitter.status().message();
  const auto fit = [&fitter](const PointCloud& target) {
    const StatusOr<FitResult> result = (*fitter)->Fit(target);
    return result.ok() && result->IsUsable() ? result->points : Points();
  };
  ExpectAlike({[&] { return fit(dolphin.target); }, [&] { return fit(further); }});
  ExpectSameBytes({fit(dolphin.target)}, {FitPair(dolphin, SolveMode::kBatch)});
}

TEST(Concurrent, TrackersGiveTheBytesOfOneAfterTheOther) {
  ExpectAlike({[] { return Track(0); }, [] { return Track(3); }});
}

TEST(SurfaceFitter, RefusesWhatCannotBeFitted) {
  const EnergyRegistry registry = BuiltinEnergies();
  PointCloud point;
  point.points.assign(5, Eigen::Vector3d::Ones());
  EXPECT_EQ(SurfaceFitter::Create(point, {}, registry).status().message(),
            "the source has no extent: all its points coincide");
  FitOptions options;
  options.num_threads = 0;
  EXPECT_FALSE(SurfaceFitter::Create(
                   MakeSyntheticShape(SyntheticShape::kDolphin, 600, 1.0), options, registry)
                   .ok());
}

}  // namespace
}  // namespace ceres_ed
