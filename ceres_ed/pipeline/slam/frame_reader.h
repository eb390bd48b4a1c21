// Reads the frames of a sequence one by one, and compares stereo pictures, each while the previous
// one is processed.
#ifndef CERES_ED_PIPELINE_SLAM_FRAME_READER_H_
#define CERES_ED_PIPELINE_SLAM_FRAME_READER_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/stereo/depth_source.h>
#include <ceres_ed/util/status.h>

#include <deque>
#include <future>

namespace ceres_ed {

// A frame, or the reason why there is none.
struct ReadFrame {
  StatusOr<DepthFrame> frame;
  FrameProblem problem;
};

class FrameReader {
 public:
  // Reads ahead on other threads if `num_threads` > 1: the next frame, or, of stereo pictures,
  // whose comparison takes longer than a frame is processed, as many as there are threads, up to
  // kMostAhead. `source` must outlive this.
  FrameReader(const DepthSource& source, int num_threads);

  // Returns frame `index`, and starts to read the next ones in the background if it reads ahead.
  ReadFrame Read(int index);

 private:
  struct Pending {
    int index = -1;
    std::future<ReadFrame> frame;
  };

  // Each frame read ahead takes memory.
  static constexpr int kMostAhead = 3;

  void ReadAhead(int index);

  const DepthSource& source_;
  int num_ahead_;
  // The frames that are read in the background, in the order of their indices.
  std::deque<Pending> ahead_;
  // Is ready when the pictures of the last of them are decoded: videos go forward only, so that
  // pictures are decoded one after the other. Invalid before the first one.
  std::shared_future<void> decoded_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_FRAME_READER_H_
