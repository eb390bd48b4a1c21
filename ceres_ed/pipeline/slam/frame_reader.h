// Reads the frames of a sequence one by one, and compares stereo pictures, each while the previous
// one is processed.
#ifndef CERES_ED_PIPELINE_SLAM_FRAME_READER_H_
#define CERES_ED_PIPELINE_SLAM_FRAME_READER_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/stereo/depth_source.h>
#include <ceres_ed/util/status.h>

#include <future>

namespace ceres_ed {

// A frame, or the reason why there is none.
struct ReadFrame {
  StatusOr<DepthFrame> frame;
  FrameProblem problem;
};

class FrameReader {
 public:
  // Reads ahead on another thread if `num_threads` > 1. `source` must outlive this.
  FrameReader(const DepthSource& source, int num_threads)
      : source_(source), reads_ahead_(num_threads > 1) {}

  // Returns frame `index`, and starts to read the next one in the background if it reads ahead.
  ReadFrame Read(int index);

 private:
  static ReadFrame Load(const DepthSource& source, int index);

  const DepthSource& source_;
  bool reads_ahead_;
  // The read of frame `next_index_` in the background; invalid if there is none.
  std::future<ReadFrame> next_;
  int next_index_ = -1;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_FRAME_READER_H_
