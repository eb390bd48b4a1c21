// The options of tracking and mapping.
#ifndef CERES_ED_SLAM_SLAM_OPTIONS_H_
#define CERES_ED_SLAM_SLAM_OPTIONS_H_

#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/solver/solver_types.h>
#include <ceres_ed/util/named_values.h>

#include <array>
#include <string>
#include <vector>

namespace ceres_ed {

// How the pose of the camera is determined.
enum class CameraMode {
  // It is estimated: first by rigid alignment, then together with the nodes, under a pose prior.
  kEstimate,
  // It never moves.
  kFixed,
  // It is given with the frames.
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
  // When its surroundings have moved. The other nodes are left for later, until the map is
  // requested.
  kLazy,
};

constexpr std::array<NamedValue<LevelTwoMode>, 2> NamesOf(LevelTwoMode) {
  return {{{"full", LevelTwoMode::kFull}, {"lazy", LevelTwoMode::kLazy}}};
}

// Options of lazy Level II, which works in waves: the unsettled nodes, and some rings around them,
// are solved while the others are held. Nodes at the rim that have moved unsettle the nodes beyond
// them.
struct LazyOptions {
  // Changes smaller than this unsettle no node; map units, > 0, default 0.01.
  double tolerance = 0.01;
  // The number of rings around the unsettled nodes, >= 1; default 3.
  int reach = 3;
  // The largest number of waves in a frame, >= 1; default 1. Nodes that are unsettled afterwards
  // wait for the next frame.
  int waves_per_frame = 1;
  // The largest number of unsettled nodes from which a wave starts, those with the largest changes;
  // >= 1, default 1000. It limits the time of a frame even if nothing holds the tissue.
  int max_seeds = 1000;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<LazyOptions>& Rows();
};

// Options of the levels of a frame.
struct LevelsOptions {
  // The weights of the energies, all >= 0 and without unit. Lengths are in node spacings and the
  // data are counted per PR node, so that a weight has the same meaning at any scale and density.
  double rotation_weight = 0.1;
  double regularization_weight = 0.1;
  // The strain at which the edges of E_reg give way (UpdateEdgeWeights); map units, >= 0, default
  // 0.15. With 0 they never do.
  double yield_strain = 0.15;
  // The weight of the expected node positions, which holds nodes that are not seen.
  double node_prior_weight = 0.02;
  double plane_weight = 1.0;
  // The weight of one feature relative to one plane.
  double feature_weight = 8.0;
  // The standard deviations of the pose prior, in degrees and map units; > 0, defaults 0.5 and 0.1.
  double prior_rotation_deg = 0.5;
  double prior_translation = 0.1;
  // Whether Level I moves the camera; default true.
  bool camera_variable = true;
  // Which nodes a level moves. The default is kTwoLevel. kMarginal eliminates the PI nodes within 8
  // rings, or all of them if Level II is full.
  StrategyOptions strategy = TwoLevels();
  LevelTwoMode level_two = LevelTwoMode::kLazy;
  LazyOptions lazy;
  // The limits of a solve. The default is one step, because the observations change with each step.
  // More steps are taken only if the first ones have no effect.
  SolverOptions solver = OneStep();
  // Additional energies, by name.
  std::vector<EnergySpec> energies;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<LevelsOptions>& Rows();
  // Return the defaults of `strategy` and of `solver`.
  static StrategyOptions TwoLevels();
  static SolverOptions OneStep();
};

// Options of the tracking of corners from picture to picture.
struct PixelTrackerOptions {
  // The side of the window that is compared; pixels, an odd number in [3, 255], default 17.
  int window = 17;
  // The number of levels of the image pyramid, in [1, 16]; default 3.
  int pyramid_levels = 3;
  // Shades wider than this are treated as illumination and removed; pixels, (0, 100], default 4.
  double light_radius = 4.0;
  // A corner that is tracked forward and backward must return to within this distance; pixels, > 0,
  // default 0.7.
  double max_round_trip = 0.7;
  // The smallest distance between two corners; pixels, >= 1, default 12.
  double min_distance = 12.0;
  // The strength of the weakest corner relative to the strongest, in (0, 1); default 0.005.
  double quality = 0.005;
  // Number of threads, >= 1, default 1. The result does not depend on it.
  int num_threads = 1;

  // Returns the options as data: the name, range and text of each.
  static const OptionTable<PixelTrackerOptions>& Rows();
};

// Options of the corners that are attached to the map.
struct FeatureOptions {
  // The wanted number of corners in view, >= 0; default 400.
  int count = 400;
  // A corner is removed if it remains farther from its position on the map than this many
  // deviations; > 0, default 6.
  double max_deviations = 6.0;
  PixelTrackerOptions pixels;

  // Returns the options as data: the name, range and text of each.
  static const OptionTable<FeatureOptions>& Rows();
};

// Options of the map's growth. Lengths are in map units (node spacings).
struct MapGrowthOptions {
  // The spacing of new points, > 0; default 0.2.
  double point_spacing = 0.2;
  // A point farther than this from every node gets a new node; > 0, default 1.
  double node_coverage = 1.0;
  // The number of nodes to which a new node is joined, >= 1; default 6.
  int edges_per_node = 6;
  // Patches that are turned farther away from the camera than this are not added until they are
  // seen better; degrees, (0, 90], default 75.
  double max_view_angle_deg = 75.0;

  // Returns the options as data: the name, range and text of each.
  static const OptionTable<MapGrowthOptions>& Rows();
};

// Options of the smoothing of depth images.
struct ObservedSurfaceOptions {
  // The distance between two cells of the grid; pixels, >= 1, default 2.
  int cell = 2;
  // A plane is fitted to the (2 radius + 1)^2 pixels around a cell; pixels, [1, 1000], default 3.
  // The tracker takes a larger radius if the slopes of the planes are too uncertain with this one.
  int radius = 3;
  // The largest standard deviation of a plane's slope (the tangent of the angle of its normal) that
  // noise may cause in the first frame; > 0, default 0.1. The tracker chooses the radius so, but
  // none above 12 pixels.
  double max_slope_noise = 0.1;
  // Slopes steeper than this relative to the picture are treated as a jump of the depth; degrees,
  // (0, 90), default 80.
  double max_slope_deg = 80.0;
  // Number of threads, >= 1, default 1. The result does not depend on it.
  int num_threads = 1;

  // Returns the options as data: the name, range and text of each.
  static const OptionTable<ObservedSurfaceOptions>& Rows();
};

// Options of the memory of tissue motion.
struct TissueMemoryOptions {
  // The largest number of moments that are stored, >= 2, default 200. If there are more, every
  // second one is removed.
  int max_moments = 200;
  // Two moments are similar if their tissue differs by less than this; map units, > 0, default
  // 0.05.
  double likeness = 0.05;
  // A moment has full weight if at least this many nodes in view now were also in view then; >= 1,
  // default 20.
  int min_common = 20;

  // Returns the options as data: the name, range and text of each.
  static const OptionTable<TissueMemoryOptions>& Rows();
};

// All options of tracking and mapping.
struct SlamOptions {
  // How the pose of the camera is determined; default kEstimate.
  CameraMode camera = CameraMode::kEstimate;
  // Whether the scene is rigid: the nodes do not move, and only the camera is tracked; default
  // false.
  bool rigid = false;
  // The node spacing in metres, >= 0. With 0, the default, about `nodes_in_view` (>= 4, default
  // 250) nodes cover the part that the first frame shows.
  double node_spacing = 0.0;
  int nodes_in_view = 250;
  // The number of nodes to which a point is bound, in [1, kMaxBoundNodes]; default 4.
  int neighbors = 4;
  // Whether corners of the colour pictures are tracked, if there are colour pictures; default true.
  bool features = true;
  // The largest number of rounds of association and Level I in a frame, >= 1; default 4.
  int rounds = 4;
  // The number of observations that Level I uses, chosen evenly among all; >= 100, default 6000.
  int max_observations = 6000;
  // The number of observations after which the running average of a point forgets older ones; >= 1,
  // default 20.
  double max_point_weight = 20.0;
  TissueMemoryOptions memory;
  // Every n-th frame is compared with the batch solution of its last problem, on a copy of the map;
  // >= 0. With 0, the default, no frame is.
  int verify_every = 0;
  // Whether each frame also computes how well its data determine the camera and the points that it
  // has moved; default false. It needs a scene that deforms.
  bool covariance = false;
  // The number of threads for everything in a frame, which replaces the numbers in the options
  // below; >= 1, default 1. The result does not depend on it.
  int num_threads = 1;
  LevelsOptions levels;
  FeatureOptions feature;
  MapGrowthOptions growth;
  ObservedSurfaceOptions surface;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<SlamOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_SLAM_OPTIONS_H_
