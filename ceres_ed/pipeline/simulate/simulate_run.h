// Writes synthetic sequences to disk.
#ifndef CERES_ED_PIPELINE_SIMULATE_SIMULATE_RUN_H_
#define CERES_ED_PIPELINE_SIMULATE_SIMULATE_RUN_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
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
  // The folder that is written.
  std::string output;
  // Whether a sequence that is already in `output` is replaced.
  bool overwrite = false;
  // The layout that is written; automatic is the native one.
  SequenceFormat layout = SequenceFormat::kAuto;
  // Whether colour images (color/) are written, too.
  bool color = true;
  // The flags for info.json. `output`, `overwrite` and `quiet` are left out of it, because the
  // contents of the files must not depend on where they are.
  RunFlags flags;
};

// What was written.
struct SimulatedSequence {
  int frames = 0;
  std::size_t truth_vertices = 0;
};

// A RunObserver that also receives what was written.
class SimulateObserver : public RunObserver {
 public:
  virtual void OnEnd(const SimulatedSequence& /*sequence*/) {}
};

// Writes the sequence with its truth. Returns how the run ended.
Outcome RunSimulation(const SimulateSettings& settings, SimulateObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SIMULATE_SIMULATE_RUN_H_
