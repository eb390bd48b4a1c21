// Short simulated sequences, most without noise, and the results of tracking and mapping.
#ifndef CERES_ED_TEST_SLAM_SLAM_RUNS_H_
#define CERES_ED_TEST_SLAM_SLAM_RUNS_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/evaluation/true_surface.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/simulation/sequences.h>
#include <ceres_ed/slam/slam.h>

#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/slam/bumpy_sequence.h>

namespace ceres_ed {

// Frames of 160 x 120 pixels with full truth.
struct ShortSequence {
  // The tissue is back at rest after `period` frames; the noise of the depth is in metres.
  explicit ShortSequence(SyntheticSceneKind kind,
                         int num_frames = 8,
                         double period = SyntheticSequenceOptions().period,
                         double noise = 0.0) {
    SyntheticSequenceOptions options;
    options.kind = kind;
    options.frames = num_frames;
    options.width = 160;
    options.height = 120;
    options.noise = noise;
    options.period = period;
    const SyntheticSequence sequence(options);
    camera = sequence.camera();
    truth.triangles = sequence.truth_mesh().triangles;
    truth.num_vertices = static_cast<int>(sequence.truth_mesh().size());
    for (int k = 0; k < num_frames; ++k) {
      frames.push_back(sequence.Render(k));
      truth.world_from_camera[k] = frames.back().world_from_camera;
      for (const Eigen::Vector3d& x : sequence.TruthPoints(k)) {
        for (int axis = 0; axis < 3; ++axis) truth.vertices.push_back(static_cast<float>(x[axis]));
      }
    }
  }

  // Returns frame k in the form that the tracking loop takes.
  SlamFrame Frame(int k) const {
    SlamFrame frame;
    frame.number = k;
    frame.depth = &frames[k].depth;
    frame.color = &frames[k].color;
    frame.world_from_camera = &frames[k].world_from_camera;
    return frame;
  }

  PinholeCamera camera;
  std::vector<SyntheticFrame> frames;
  SceneTruth truth;
};

// Returns a sequence that is made once.
inline const ShortSequence& KidneySequence() {
  static const ShortSequence sequence(SyntheticSceneKind::kKidney);
  return sequence;
}
inline const ShortSequence& StripSequence() {
  static const ShortSequence sequence(SyntheticSceneKind::kStrip);
  return sequence;
}

// Returns options with fewer nodes than the default, for tests that do not need accuracy.
inline SlamOptions FastOptions() {
  SlamOptions options;
  options.nodes_in_view = 80;
  return options;
}

inline Eigen::Isometry3d ToIsometry(const CameraPose& pose) {
  return Eigen::Translation3d(pose.translation) * pose.rotation;
}

inline std::unique_ptr<DeformableSlam> MakeSlam(const PinholeCamera& camera,
                                                const SlamOptions& options = {}) {
  const EnergyRegistry registry = BuiltinEnergies();
  auto slam = DeformableSlam::Create(camera, options, registry);
  CHECK(slam.ok()) << slam.status().message();
  return *std::move(slam);
}

// Returns a tracker for BumpyScene.
inline std::unique_ptr<DeformableSlam> MakeBumpySlam() {
  SlamOptions options;
  options.nodes_in_view = 40;
  return MakeSlam(BumpyCamera(), options);
}

// Returns every point of the map in the present camera frame, in metres.
inline LiveSnapshot Snapshot(const DeformableSlam& slam, int frame) {
  LiveSnapshot snapshot;
  snapshot.frame = frame;
  const DeformableMap& map = slam.map();
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    if (!map.alive(slot)) continue;
    const MapPoint point = map.point(slot);
    const PointBinding binding = map.binding(slot);
    const Eigen::Vector3d in_map = WarpPoint(map.graph(), map.state(), binding, point.position);
    snapshot.points.push_back(slam.unit() * (slam.camera_from_map() * in_map));
    snapshot.ids.push_back(point.id);
    snapshot.birth_frames.push_back(point.birth_frame);
    snapshot.birth_points.push_back(slam.unit() * point.birth_position);
  }
  return snapshot;
}

// A complete run, with the state after every frame.
struct SlamRun {
  SlamRun(const ShortSequence& sequence, const SlamOptions& options) {
    slam = MakeSlam(sequence.camera, options);
    for (int k = 0; k < static_cast<int>(sequence.frames.size()); ++k) {
      reports.push_back(slam->Process(sequence.Frame(k)));
      cameras.push_back(slam->camera_from_map());
      snapshots.push_back(Snapshot(*slam, k));
    }
  }

  std::unique_ptr<DeformableSlam> slam;
  std::vector<FrameReport> reports;
  std::vector<CameraPose> cameras;
  std::vector<LiveSnapshot> snapshots;
};

// Returns the errors of every frame.
inline std::vector<FrameTruthError> Evaluate(const ShortSequence& sequence, const SlamRun& run) {
  TruthEvaluator evaluator(sequence.camera, sequence.truth);
  std::vector<FrameTruthError> errors;
  for (const LiveSnapshot& snapshot : run.snapshots) {
    const StatusOr<FrameTruthError> error = evaluator.Evaluate(snapshot);
    EXPECT_TRUE(error.ok()) << error.status().message();
    if (error.ok()) errors.push_back(*error);
  }
  return errors;
}

// Returns all results of a run, except for times, to compare runs bit by bit. Lengths are in map
// units.
inline std::vector<double> Bytes(const SlamRun& run) {
  std::vector<double> all;
  const auto add = [&all](const auto& values) {
    all.insert(all.end(), values.data(), values.data() + values.size());
  };
  const DeformableMap& map = run.slam->map();
  for (int j = 0; j < map.graph().num_nodes(); ++j) {
    add(map.graph().position(j));
    all.insert(all.end(), map.state().node(j), map.state().node(j) + kNodeSize);
  }
  for (const GraphEdge& e : map.graph().edges()) {
    all.insert(all.end(), {static_cast<double>(e.from), static_cast<double>(e.to), e.weight});
  }
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    const MapPoint point = map.point(slot);
    all.push_back(point.id);
    if (!map.alive(slot)) continue;
    add(point.position);
    add(point.normal);
    all.push_back(point.weight);
  }
  for (const CameraPose& pose : run.cameras) {
    add(pose.rotation.coeffs());
    add(pose.translation);
  }
  for (const FrameReport& r : run.reports) {
    all.insert(all.end(),
               {static_cast<double>(r.status),
                static_cast<double>(r.inliers),
                static_cast<double>(r.features),
                static_cast<double>(r.iterations),
                r.energy});
  }
  return all;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_SLAM_SLAM_RUNS_H_
