#include "ceres_ed/pipeline/slam/frame_reader.h"

#include <functional>
#include <utility>

namespace ceres_ed {

ReadFrame FrameReader::Load(const DepthSource& source, int index) {
  FrameProblem problem = FrameProblem::kNone;
  StatusOr<DepthFrame> frame = source.Load(index, &problem);
  return {std::move(frame), problem};
}

ReadFrame FrameReader::Read(int index) {
  const bool is_on_its_way = next_.valid() && next_index_ == index;
  ReadFrame read = is_on_its_way ? next_.get() : Load(source_, index);
  if (reads_ahead_ && index + 1 < source_.num_frames()) {
    next_index_ = index + 1;
    next_ = std::async(std::launch::async, Load, std::cref(source_), next_index_);
  }
  return read;
}

}  // namespace ceres_ed
