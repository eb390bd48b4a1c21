// The frames of a sequence one by one, read while the frame before is taken in.
#ifndef CERES_ED_PIPELINE_SLAM_FRAME_READER_H_
#define CERES_ED_PIPELINE_SLAM_FRAME_READER_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/util/status.h>

#include <future>

namespace ceres_ed {

// A frame, or why there is none.
struct ReadFrame {
  StatusOr<DepthFrame> frame;
  FrameProblem problem;
};

class FrameReader {
 public:
  // Reads ahead on a thread of its own if there may be more than one. `sequence` must outlive it.
  FrameReader(const DepthSequence& sequence, int num_threads)
      : sequence_(sequence), reads_ahead_(num_threads > 1) {}

  // Returns frame `index`, and has the one behind it read meanwhile.
  ReadFrame Read(int index);

 private:
  static ReadFrame Load(const DepthSequence& sequence, int index);

  const DepthSequence& sequence_;
  bool reads_ahead_;
  // Frame `next_index_` on its way, or nothing.
  std::future<ReadFrame> next_;
  int next_index_ = -1;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_FRAME_READER_H_
