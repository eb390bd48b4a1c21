#include "ceres_ed/slam/slam_options.h"

#include <ceres_ed/util/options.h>

#include <algorithm>
#include <limits>
#include <thread>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {

const OptionTable<LazyOptions>& LazyOptions::Rows() {
  using O = LazyOptions;
  static const OptionTable<O> rows({
      Row(&O::tolerance, "tolerance", "A node that moves less than this unsettles no other node.")
          .In(Above(0))
          .Unit("node spacings"),
      Row(&O::reach, "reach", "The rings around unsettled nodes that are solved with them.")
          .In(AtLeast(1)),
      Row(&O::waves_per_frame, "waves_per_frame", "The most waves in a frame; the rest waits.")
          .In(AtLeast(1)),
      Row(&O::max_seeds, "max_seeds", "The most unsettled nodes that a wave starts from.")
          .In(AtLeast(1)),
  });
  return rows;
}

bool LazyOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

const OptionTable<LevelsOptions>& LevelsOptions::Rows() {
  using O = LevelsOptions;
  static const OptionTable<O> rows({
      Nested(&O::strategy, StrategyOptions::Rows()),
      Row(&O::rotation_weight,
          "w_rot",
          "The weight of E_rot, which keeps each node near a rotation.")
          .In(AtLeast(0)),
      Row(&O::regularization_weight, "w_reg", "The weight of E_reg, which makes neighbours agree.")
          .In(AtLeast(0)),
      Row(&O::yield_strain,
          "yield_strain",
          "Edges with more strain give way, as where a fold is pulled over what is behind it.")
          .In(AtLeast(0))
          .Unit("node spacings")
          .Special(0, "never"),
      Row(&O::node_prior_weight,
          "w_node_prior",
          "The weight that holds hidden nodes where they are thought to be.")
          .In(AtLeast(0)),
      Row(&O::plane_weight, "w_data", "The weight of the distance to the depth.").In(AtLeast(0)),
      Row(&O::feature_weight, "w_feature", "The weight of a corner compared with a plane.")
          .In(AtLeast(0)),
      Row(&O::prior_rotation_deg, "prior_rotation_deg", "The spread of the pose prior: rotation.")
          .In(Above(0))
          .Unit("degrees"),
      Row(&O::prior_translation, "prior_translation", "The spread of the pose prior: translation.")
          .In(Above(0))
          .Unit("node spacings"),
      Row(&O::camera_variable, "camera_variable", "Whether level I moves the camera.")
          .Group(OptionGroup::kInternal),
      Row(&O::level_two,
          "level2",
          "Level II of two_level moves hidden nodes in every frame (full), or when they have a "
          "reason to move (lazy).")
          .OnResume(ResumeRule::kNoted)
          .Main(),
      Nested(&O::lazy, LazyOptions::Rows(), "lazy_"),
      Nested(&O::solver, SolverOptions::Rows(), "solver_").Group(OptionGroup::kInternal),
      NotData(&O::energies),
  });
  return rows;
}

bool LevelsOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

const OptionTable<PixelTrackerOptions>& PixelTrackerOptions::Rows() {
  using O = PixelTrackerOptions;
  static const OptionTable<O> rows({
      Row(&O::window, "window", "The side of the window around a corner; an odd number.")
          .In(Between(3, 255))
          .Unit("pixels"),
      Row(&O::pyramid_levels, "pyramid_levels", "The levels of the pyramid of pictures.")
          .In(Between(1, 16)),
      Row(&O::light_radius, "light_radius", "Wider shades are taken for light and removed.")
          .In(AboveUpTo(0, 100))
          .Unit("pixels"),
      Row(&O::max_round_trip,
          "max_round_trip",
          "A corner followed forward and back must return to within this distance.")
          .In(Above(0))
          .Unit("pixels"),
      Row(&O::min_distance, "min_distance", "The smallest distance between two corners.")
          .In(AtLeast(1))
          .Unit("pixels"),
      Row(&O::quality, "quality", "The strength of the weakest corner; the strongest has 1.")
          .In(Inside(0, 1)),
      Row(&O::num_threads, "num_threads", "The result does not depend on it.").In(AtLeast(1)),
  });
  return rows;
}

const OptionTable<FeatureOptions>& FeatureOptions::Rows() {
  using O = FeatureOptions;
  static const OptionTable<O> rows({
      Row(&O::count, "count", "The number of corners wanted in view.").In(AtLeast(0)),
      Row(&O::max_deviations,
          "max_deviations",
          "A corner that stays farther from where the map has it is dropped.")
          .In(Above(0))
          .Unit("standard deviations"),
      Nested(&O::pixels, PixelTrackerOptions::Rows()),
  });
  return rows;
}

const OptionTable<MapGrowthOptions>& MapGrowthOptions::Rows() {
  using O = MapGrowthOptions;
  static const OptionTable<O> rows({
      Row(&O::point_spacing, "point_spacing", "The distance between new points.")
          .In(Above(0))
          .Unit("node spacings"),
      Row(&O::node_coverage, "node_coverage", "A point farther from every node gets a new node.")
          .In(Above(0))
          .Unit("node spacings"),
      Row(&O::edges_per_node, "edges_per_node", "The partners of a new node.").In(AtLeast(1)),
      Row(&O::max_view_angle_deg,
          "max_view_angle_deg",
          "Surface that is turned farther from the camera is left until it is seen better.")
          .In(AboveUpTo(0, 90))
          .Unit("degrees"),
  });
  return rows;
}

const OptionTable<ObservedSurfaceOptions>& ObservedSurfaceOptions::Rows() {
  using O = ObservedSurfaceOptions;
  static const OptionTable<O> rows({
      Row(&O::cell, "cell", "The distance between two cells of the grid of planes.")
          .In(AtLeast(1))
          .Unit("pixels"),
      Row(&O::radius, "radius", "A plane is fitted to the pixels within this distance at least.")
          .In(Between(1, 1000))
          .Unit("pixels"),
      Row(&O::max_slope_noise,
          "max_slope_noise",
          "If noise makes the slopes of planes less certain, their radius is larger.")
          .In(Above(0)),
      Row(&O::max_slope_deg, "max_slope_deg", "A steeper slope is taken for a jump in depth.")
          .In(Inside(0, 90))
          .Unit("degrees"),
      Row(&O::num_threads, "num_threads", "The result does not depend on it.").In(AtLeast(1)),
  });
  return rows;
}

const OptionTable<TissueMemoryOptions>& TissueMemoryOptions::Rows() {
  using O = TissueMemoryOptions;
  static const OptionTable<O> rows({
      Row(&O::max_moments, "max_moments", "If there are more, every second one is forgotten.")
          .In(AtLeast(2)),
      Row(&O::likeness, "likeness", "Two moments whose tissue differs by less are alike.")
          .In(Above(0))
          .Unit("node spacings"),
      Row(&O::min_common,
          "min_common",
          "A moment counts in full if this many nodes in view were also in view then.")
          .In(AtLeast(1)),
  });
  return rows;
}

const OptionTable<SlamOptions>& SlamOptions::Rows() {
  using O = SlamOptions;
  static const OptionTable<O> rows({
      Nested(&O::levels, LevelsOptions::Rows()),
      Row(&O::camera,
          "camera",
          "Whether the camera is estimated, never moves, or moves as the sequence says.")
          .Main(),
      Row(&O::rigid, "rigid", "The scene does not deform: only the camera moves.").Main(),
      Row(&O::node_spacing, "node_spacing", "The distance between nodes.")
          .In(AtLeast(0))
          .Unit("metres")
          .Special(0, "automatic")
          .Main(),
      Row(&O::nodes_in_view,
          "nodes_in_view",
          "The number of nodes that cover the first frame, if node_spacing is 0.")
          .In(AtLeast(4))
          .Main(),
      Row(&O::neighbors, "neighbors", "The number of nodes that move a point.")
          .In(Between(1, kMaxBoundNodes)),
      Row(&O::features, "features", "Whether corners of the colour pictures are followed.")
          .Words("auto", "none")
          .Main(),
      Row(&O::rounds, "rounds", "The most steps of association and level I in a frame.")
          .In(AtLeast(1)),
      Row(&O::max_observations,
          "max_observations",
          "The points of the map that are compared with a frame.")
          .In(AtLeast(100)),
      Row(&O::max_point_weight,
          "max_point_weight",
          "The average of a point forgets after this many observations.")
          .In(AtLeast(1)),
      Nested(&O::memory, TissueMemoryOptions::Rows(), "memory_"),
      Row(&O::verify_every,
          "verify_every",
          "Compare every n-th frame with the batch solve, on a copy of the map.")
          .In(AtLeast(0))
          .Special(0, "none")
          .OnResume(ResumeRule::kFree),
      Row(&O::covariance,
          "covariance",
          "Also compute how well each frame determines the camera and the points."),
      Row(&O::num_threads, "threads", "The threads; the result does not depend on them.")
          .In(AtLeast(1))
          .Special(0, std::max(1u, std::thread::hardware_concurrency()), "auto")
          .OnResume(ResumeRule::kFree)
          .Main(),
      Nested(&O::feature, FeatureOptions::Rows(), "feature_").Internal("feature_num_threads"),
      Nested(&O::growth, MapGrowthOptions::Rows(), "growth_"),
      Nested(&O::surface, ObservedSurfaceOptions::Rows(), "surface_")
          .Internal("surface_num_threads"),
  });
  return rows;
}

bool SlamOptions::IsValid(std::string* error) const {
  if (!Rows().Check(*this, error)) return false;
  if (covariance && rigid) {
    *error =
        "covariance is true and rigid is true, expected one of them: they are those of a "
        "deformation";
    return false;
  }
  if (feature.pixels.window % 2 == 1) return true;
  *error = "feature_window is " + std::to_string(feature.pixels.window) +
           ", expected an odd number of pixels";
  return false;
}

}  // namespace ceres_ed
