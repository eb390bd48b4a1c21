// The options of a tracker: those of ed_slam by the names of its flags, and some that only C++ has.
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/choices.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/slam/slam.h>

namespace ceres_ed::python {
namespace {

using O = SlamOptions;

constexpr Choice<CameraMode> kCameras[] = {{"estimate", CameraMode::kEstimate},
                                           {"fixed", CameraMode::kFixed},
                                           {"given", CameraMode::kGiven}};
constexpr Choice<LevelTwoMode> kLevelTwos[] = {{"lazy", LevelTwoMode::kLazy},
                                               {"full", LevelTwoMode::kFull}};

}  // namespace

void BindTrackerOptions(py::module_& module) {
  OptionsClass<O> options(module, "TrackerOptions", R"(How frames are taken in. Lengths in metres.

Each option is an attribute, and a keyword of this class and of Tracker. Those that ed_slam has are
named like its flags.)");
  options
      .Add(
          "mode",
          [](O & o) -> auto& { return o.levels.strategy.mode; },
          kModes,
          "'two_level': nodes in view, then the rest; 'batch': all; 'marginal': as batch, from "
          "those in view.")
      .Add(
          "rings",
          [](O & o) -> auto& { return o.levels.strategy.rings; },
          "Rings of hidden nodes that level I moves too, >= 0.")
      .Add(
          "boundary",
          [](O & o) -> auto& { return o.levels.strategy.seam_edges; },
          kBoundaries,
          "two_level: 'keep' or 'cut' edges across the seam of level I.")
      .Add(
          "level2",
          [](O & o) -> auto& { return o.levels.level_two; },
          kLevelTwos,
          "two_level: 'lazy': the rest moves when it has reason to; 'full': in every frame.")
      .Add(
          "camera",
          [](O & o) -> auto& { return o.camera; },
          kCameras,
          "'estimate'; 'fixed': it never moves; 'given': by the poses of track().")
      .Add(
          "features",
          [](O & o) -> auto& { return o.features; },
          "Follow corners of the colour images, where there are any.")
      .Add(
          "node_spacing",
          [](O & o) -> auto& { return o.node_spacing; },
          "Distance of nodes, metres, >= 0; 0: from nodes_in_view.")
      .Add(
          "nodes_in_view",
          [](O & o) -> auto& { return o.nodes_in_view; },
          "About so many nodes cover what the first frame shows.")
      .Add(
          "neighbors",
          [](O & o) -> auto& { return o.neighbors; },
          "Nodes that carry a point, 1 to 8.")
      .Add(
          "w_rot",
          [](O & o) -> auto& { return o.levels.rotation_weight; },
          "Weight of E_rot: each node near a rotation, >= 0.")
      .Add(
          "w_reg",
          [](O & o) -> auto& { return o.levels.regularization_weight; },
          "Weight of E_reg: neighbours agree, >= 0.")
      .Add(
          "w_data",
          [](O & o) -> auto& { return o.levels.plane_weight; },
          "Weight of the distance to the depth, >= 0.")
      .Add(
          "rounds",
          [](O & o) -> auto& { return o.rounds; },
          "Times at most that a frame is associated and level I takes a step, >= 1.")
      .Add(
          "max_observations",
          [](O & o) -> auto& { return o.max_observations; },
          "Points of the map that are held against a frame, >= 100.")
      .Add(
          "verify_every",
          [](O & o) -> auto& { return o.verify_every; },
          "Hold every n-th frame against the batch solve, on a copy; 0: none.")
      .Add(
          "threads",
          [](O & o) -> auto& { return o.num_threads; },
          "Changes the time, not the result, >= 1.");
}

}  // namespace ceres_ed::python
