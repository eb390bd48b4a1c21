#include "ceres_ed/io/sequence/depth_sequence.h"

#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/sequence_listing.h>

#include <cstddef>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

void ApplyMask(const MaskImage& mask, DepthImage* depth) {
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    if (mask.pixels()[i] == 0) depth->pixels()[i] = 0.0F;
  }
}

}  // namespace

DepthSequence::DepthSequence(SequenceListing listing, std::string description)
    : listing_(std::make_unique<const SequenceListing>(std::move(listing))),
      description_(std::move(description)) {
  CHECK(!listing_->entries.empty()) << "a sequence has at least one frame";
}

DepthSequence::~DepthSequence() = default;

const PinholeCamera& DepthSequence::camera() const { return listing_->camera.camera; }

double DepthSequence::depth_units_per_metre() const {
  return listing_->camera.depth_units_per_metre;
}

int DepthSequence::num_frames() const { return static_cast<int>(listing_->entries.size()); }

int DepthSequence::frame_number(int i) const { return entry(i).number; }

double DepthSequence::time_s(int i) const { return entry(i).time_s; }

const std::vector<std::string>& DepthSequence::warnings() const { return listing_->warnings; }

const SequenceEntry& DepthSequence::entry(int i) const {
  CHECK_GE(i, 0);
  CHECK_LT(i, num_frames());
  return listing_->entries[static_cast<std::size_t>(i)];
}

const CameraPose* DepthSequence::given_pose(int i) const {
  const std::optional<CameraPose>& pose = entry(i).world_from_camera;
  return pose.has_value() ? &*pose : nullptr;
}

bool DepthSequence::has_color() const {
  for (const SequenceEntry& entry : listing_->entries) {
    if (!entry.color_path.empty()) return true;
  }
  return false;
}

Status DepthSequence::CheckSize(const std::string& path, int width, int height) const {
  if (width == camera().width && height == camera().height) return Status::Ok();
  return Status::Error(path + ": " + SizeText(width, height) + ", expected " +
                       SizeText(camera().width, camera().height) + " as the camera has");
}

Status DepthSequence::LoadDepth(const SequenceEntry& entry,
                                DepthFrame* frame,
                                FrameProblem* problem) const {
  DepthImage* const depth = &frame->depth;
  StatusOr<DepthImage> read =
      ReadDepthImage(entry.depth_path, depth_units_per_metre(), &frame->saturated);
  *problem = FrameProblem::kUnreadable;
  if (!read.ok()) return read.status();
  *depth = std::move(*read);
  Status size = CheckSize(entry.depth_path, depth->width(), depth->height());
  *problem = FrameProblem::kWrongSize;
  if (!size.ok()) return size;
  *problem = FrameProblem::kNone;
  if (entry.mask_path.empty()) return Status::Ok();

  const StatusOr<MaskImage> mask = ReadMaskImage(entry.mask_path);
  *problem = FrameProblem::kUnreadable;
  if (!mask.ok()) return mask.status();
  size = CheckSize(entry.mask_path, mask->width(), mask->height());
  *problem = FrameProblem::kWrongSize;
  if (!size.ok()) return size;
  *problem = FrameProblem::kNone;
  ApplyMask(*mask, depth);
  return Status::Ok();
}

// Depth is essential, colour is not: a frame is used even if its colour image is damaged.
Status DepthSequence::LoadColor(const SequenceEntry& entry,
                                DepthFrame* frame,
                                FrameProblem* problem) const {
  StatusOr<ColorImage> color = ReadColorImage(entry.color_path);
  if (!color.ok()) {
    frame->warning = color.status().message() + ": the frame is used without colour";
    return Status::Ok();
  }
  Status size = CheckSize(entry.color_path, color->width(), color->height());
  if (!size.ok()) {
    *problem = FrameProblem::kWrongSize;
    return size;
  }
  frame->color = std::move(*color);
  return Status::Ok();
}

StatusOr<DepthFrame> DepthSequence::Load(int i, FrameProblem* problem) const {
  const SequenceEntry& entry = this->entry(i);
  FrameProblem ignored = FrameProblem::kNone;
  if (problem == nullptr) problem = &ignored;
  *problem = FrameProblem::kNone;
  DepthFrame frame;
  frame.number = entry.number;
  frame.time_s = entry.time_s;
  Status status = LoadDepth(entry, &frame, problem);
  if (status.ok() && !entry.color_path.empty()) status = LoadColor(entry, &frame, problem);
  if (!status.ok()) return status;
  return frame;
}

}  // namespace ceres_ed
