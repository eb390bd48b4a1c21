// How a sequence is tracked and mapped.
#ifndef CERES_ED_SLAM_SLAM_OPTIONS_H_
#define CERES_ED_SLAM_SLAM_OPTIONS_H_

#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/solver/solver_types.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/options_fwd.h>

#include <array>
#include <string>
#include <vector>

namespace ceres_ed {

// What decides where the camera is.
enum class CameraMode {
  // Rigid alignment first, then along with the nodes, under a pose prior.
  kEstimate,
  // It never moves.
  kFixed,
  // The poses that come with the frames.
  kGiven,
};

constexpr std::array<NamedValue<CameraMode>, 3> NamesOf(CameraMode) {
  return {{{"estimate", CameraMode::kEstimate},
           {"fixed", CameraMode::kFixed},
           {"given", CameraMode::kGiven}}};
}

// When Level II moves a PI node.
enum class LevelTwoMode {
  // In every frame.
  kFull,
  // When what pulls at it has moved; the others are left behind until somebody asks for them.
  kLazy,
};

constexpr std::array<NamedValue<LevelTwoMode>, 2> NamesOf(LevelTwoMode) {
  return {{{"full", LevelTwoMode::kFull}, {"lazy", LevelTwoMode::kLazy}}};
}

// A wave goes out from what has moved: the unsettled nodes, and so many rings around them, are
// solved with the rest held; those at the rim that have moved unsettle the nodes behind them.
struct LazyOptions {
  // Changes that are smaller unsettle nobody, map units, > 0.
  double tolerance = 0.01;
  // Rings around the unsettled nodes, >= 1.
  int reach = 3;
  // Waves a frame at most, >= 1; what is unsettled then waits for the next frame.
  int waves_per_frame = 1;
  // Unsettled nodes that a wave starts from at most, those with the largest changes, >= 1: keeps a
  // frame's time even where nothing holds the tissue.
  int max_seeds = 1000;

  // False, with the option and what was expected in `error`, when a value is out of range.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<LazyOptions>& Rows();
};

struct LevelsOptions {
  // Lengths are node spacings, and the data are counted per PR node, so that these mean the same
  // at any scale and density. All >= 0.
  double rotation_weight = 0.1;
  double regularization_weight = 0.1;
  // Of nodes to where they are thought to be: holds what nobody sees.
  double node_prior_weight = 0.02;
  double plane_weight = 1.0;
  // Of one feature against one plane.
  double feature_weight = 4.0;
  // Pull of the pose prior: spreads in degrees and map units, > 0.
  double prior_rotation_deg = 0.5;
  double prior_translation = 0.1;
  bool camera_variable = true;
  // Which nodes a level moves. By default kTwoLevel; kMarginal eliminates the PI nodes within 8
  // rings, or all of them where Level II is full.
  StrategyOptions strategy = TwoLevels();
  LevelTwoMode level_two = LevelTwoMode::kLazy;
  LazyOptions lazy;
  // One step by default: the observations change with it. More are taken only where the first ones
  // bring nothing.
  SolverOptions solver = OneStep();
  // More energies, by name.
  std::vector<EnergySpec> energies;

  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<LevelsOptions>& Rows();
  // The defaults of `strategy` and of `solver`.
  static StrategyOptions TwoLevels();
  static SolverOptions OneStep();
};

struct PixelTrackerOptions {
  // Side of the window that is matched, pixels, odd, >= 3.
  int window = 17;
  int pyramid_levels = 3;
  // Shades wider than this are taken for light and removed, pixels, > 0.
  double light_radius = 4.0;
  // A corner tracked forward and back again must return to within this, pixels, > 0.
  double max_round_trip = 0.7;
  // Between two corners, pixels, >= 1.
  double min_distance = 12.0;
  // Strength of the weakest corner relative to the strongest, in (0, 1).
  double quality = 0.005;
  // Corners are followed on so many threads, >= 1; the result doesn't depend on it.
  int num_threads = 1;

  // The options as data: name, range and text of each.
  static const OptionTable<PixelTrackerOptions>& Rows();
};

struct FeatureOptions {
  // Corners wanted in view, >= 0.
  int count = 400;
  // A corner that stays farther from where the map has it than this many deviations is dropped.
  double max_deviations = 6.0;
  PixelTrackerOptions pixels;

  // The options as data: name, range and text of each.
  static const OptionTable<FeatureOptions>& Rows();
};

// Lengths in map units (node spacings).
struct MapGrowthOptions {
  // Between new points, > 0.
  double point_spacing = 0.2;
  // A point farther from every node than this asks for a new node, > 0.
  double node_coverage = 1.0;
  // Partners that a new node takes, >= 1.
  int edges_per_node = 6;
  // Patches turned farther from the camera are left until they are seen better, degrees.
  double max_view_angle_deg = 75.0;

  // The options as data: name, range and text of each.
  static const OptionTable<MapGrowthOptions>& Rows();
};

// How depth images are smoothed.
struct ObservedSurfaceOptions {
  // Pixels between two cells of the grid, >= 1.
  int cell = 2;
  // A plane is fitted to the (2 radius + 1)^2 pixels around a cell, >= 1.
  int radius = 3;
  // Slopes steeper than this against the picture are taken for a jump; degrees, (0, 90).
  double max_slope_deg = 80.0;
  // Threads of the fit, >= 1; the result doesn't depend on it.
  int num_threads = 1;

  // The options as data: name, range and text of each.
  static const OptionTable<ObservedSurfaceOptions>& Rows();
};

struct TissueMemoryOptions {
  // Moments that are kept, >= 2; when there are more, every second one is forgotten.
  int max_moments = 200;
  // Two moments whose tissue differs by less are alike, map units, > 0.
  double likeness = 0.05;
  // A moment counts in full when this many nodes in view were in view then too, >= 1.
  int min_common = 20;

  // The options as data: name, range and text of each.
  static const OptionTable<TissueMemoryOptions>& Rows();
};

struct SlamOptions {
  CameraMode camera = CameraMode::kEstimate;
  // Metres; 0 = so that about `nodes_in_view` nodes cover what the first frame shows.
  double node_spacing = 0.0;
  int nodes_in_view = 250;
  // Nodes that carry a point, in [1, kMaxBoundNodes].
  int neighbors = 4;
  // Follow corners of the colour image, where there is one.
  bool features = true;
  // Times at most that a frame is associated and Level I takes a step, >= 1.
  int rounds = 4;
  // Observations that Level I takes, evenly chosen among more, >= 100.
  int max_observations = 6000;
  // Number of observations after which the running average of a point forgets, >= 1.
  double max_point_weight = 20.0;
  TissueMemoryOptions memory;
  // Hold every n-th frame against the batch solve of its last problem, on a copy; 0 = none.
  int verify_every = 0;
  // Threads of everything that a frame takes, whatever the options below say, >= 1; the result
  // doesn't depend on it.
  int num_threads = 1;
  LevelsOptions levels;
  FeatureOptions feature;
  MapGrowthOptions growth;
  ObservedSurfaceOptions surface;

  // False, with the option and what was expected in `error`, when a value is out of range.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<SlamOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_SLAM_OPTIONS_H_
