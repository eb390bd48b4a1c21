// Synthetic sequences on disk.
#ifndef CERES_ED_PIPELINE_SIMULATE_SIMULATE_RUN_H_
#define CERES_ED_PIPELINE_SIMULATE_SIMULATE_RUN_H_

#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/pipeline/run_observer.h>
#include <ceres_ed/simulation/sequences.h>

#include <cstddef>
#include <string>

namespace ceres_ed {

struct SimulateSettings {
  SyntheticSequenceOptions options;
  // The name of the scene, for info.json.
  std::string scene;
  // The folder to write.
  std::string output;
  // Whether to replace a sequence that is in `output`.
  bool overwrite = false;
  // Whether to write color/ too.
  bool color = true;
  // For info.json. Where the files are must not change what is in them: `output`, `overwrite` and
  // `quiet` are left out.
  RunFlags flags;
};

// What was written.
struct SimulatedSequence {
  int frames = 0;
  std::size_t truth_vertices = 0;
};

// As of RunObserver, and with what was written.
class SimulateObserver : public RunObserver {
 public:
  virtual void OnEnd(const SimulatedSequence& /*sequence*/) {}
};

// Writes the sequence in the native layout, with its truth. Returns how it ended.
Outcome RunSimulation(const SimulateSettings& settings, SimulateObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SIMULATE_SIMULATE_RUN_H_
