// The settings of a cohort: one template fitted to many shapes, many pairs, or many sequences.
#ifndef CERES_ED_PIPELINE_COHORT_COHORT_SETTINGS_H_
#define CERES_ED_PIPELINE_COHORT_COHORT_SETTINGS_H_

#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/pipeline/verdict.h>
#include <ceres_ed/statistics/procrustes.h>

#include <string>
#include <vector>

namespace ceres_ed {

// A part of a cohort: every `count`-th shape, beginning with number `index` (1, ..., count).
struct Shard {
  int index = 1;
  int count = 1;

  bool Contains(int row) const { return row % count == index - 1; }
  bool IsWhole() const { return count == 1; }
};

// What is made of the shapes after they have been fitted.
struct ModelSettings {
  // What is taken out of the shapes before their statistics.
  Alignment align = Alignment::kSimilarity;
  // The most principal components.
  int components = 20;
  // The random assignments of the test of groups.
  int permutations = 1000;
  // The worst verdict with which a shape takes part in mean and components.
  Grade worst = Grade::kDoubtful;
};

struct CohortSettings {
  // The settings of each fit. Its inputs and outputs are set for each shape, except for
  // `source_landmarks` and `fixed`, which belong to the template. `fit.flags` are the flags that
  // have an effect on a fit.
  FitSettings fit;
  // The settings of the tracking of each sequence.
  SlamSettings slam;
  // The template; empty for pairs and sequences.
  std::string source;
  // The shapes: a table or a folder (manifest.h). One of the three is given.
  std::string manifest;
  std::string pairs;
  std::string sequences;
  // The folder that is written.
  std::string output;
  Shard shard;
  // Whether what is done is skipped, and whether what has failed counts as done.
  bool resume = true;
  bool retry_failed = false;
  // The number of shapes that are fitted at a time; 0 = one for each core.
  int jobs = 0;
  // The memory that all fits of the process may take together; 0 = unlimited.
  int memory_mb = 0;
  // How often the mean becomes the template.
  int iterate = 0;
  // The unit of the template (um, mm, cm, in, m), for shapes whose row names another one.
  std::string unit;
  // Whether each shape gets a page and a small picture, and whether its warp is kept.
  bool pages = true;
  bool warps = false;
  ModelSettings model;
};

// What is joined by --collect.
struct CollectSettings {
  // Folders of cohorts, at least one.
  std::vector<std::string> folders;
  // The folder that is written; empty for the first one of `folders`.
  std::string output;
  ModelSettings model;
  FailIf fail_if = FailIf::kNever;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_COHORT_SETTINGS_H_
