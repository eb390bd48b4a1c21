#include "ceres_ed/pipeline/slam/frame_reader.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace ceres_ed {

namespace {

// Says at the end of its life, also if something was thrown, that pictures are decoded.
struct DecodedAtEnd {
  std::promise<void>* promise;
  ~DecodedAtEnd() { promise->set_value(); }
};

StatusOr<DepthFrame> Decode(const DepthSource& source,
                            int index,
                            std::promise<void>* decoded,
                            FrameProblem* problem) {
  const DecodedAtEnd at_end{decoded};
  return source.LoadPictures(index, problem);
}

}  // namespace

FrameReader::FrameReader(const DepthSource& source, int num_threads)
    : source_(source), num_ahead_(num_threads > 1 ? 1 : 0) {
  if (source.is_stereo() && num_threads > 1) num_ahead_ = std::min(num_threads, kMostAhead);
}

// Starts to read a frame when the pictures of the one before are decoded.
void FrameReader::ReadAhead(int index) {
  auto decoded = std::make_shared<std::promise<void>>();
  const std::shared_future<void> before = std::exchange(decoded_, decoded->get_future().share());
  const auto read = [&source = source_, index, before, decoded] {
    if (before.valid()) before.wait();
    FrameProblem problem = FrameProblem::kNone;
    StatusOr<DepthFrame> pictures = Decode(source, index, decoded.get(), &problem);
    return ReadFrame{source.FindDepth(std::move(pictures)), problem};
  };
  ahead_.push_back({index, std::async(std::launch::async, read)});
}

ReadFrame FrameReader::Read(int index) {
  if (num_ahead_ == 0) {
    FrameProblem problem = FrameProblem::kNone;
    StatusOr<DepthFrame> frame = source_.Load(index, &problem);
    return {std::move(frame), problem};
  }
  while (!ahead_.empty() && ahead_.front().index != index) {
    ahead_.front().frame.wait();
    ahead_.pop_front();
  }
  if (ahead_.empty()) ReadAhead(index);
  std::future<ReadFrame> frame = std::move(ahead_.front().frame);
  ahead_.pop_front();
  // The next frames start while this one may still be on its way.
  int last = ahead_.empty() ? index : ahead_.back().index;
  while (static_cast<int>(ahead_.size()) < num_ahead_ && ++last < source_.num_frames()) {
    ReadAhead(last);
  }
  return frame.get();
}

}  // namespace ceres_ed
