#include "ceres_ed/io/sequence/depth_sequence.h"

#include <ceres_ed/io/sequence/picture_reader.h>
#include <ceres_ed/io/sequence/sequence_listing.h>

#include <cmath>
#include <cstddef>
#include <sstream>
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

// Returns a sentence about what to do if the pictures are the calibrated ones, made smaller or
// larger; otherwise an empty string.
std::string ScaleHint(const PinholeCamera& camera, int width, int height) {
  const double scale = static_cast<double>(width) / camera.width;
  if (height != std::lround(scale * camera.height)) return "";
  std::ostringstream text;
  text << "; if they were resized, multiply fx, fy, cx and cy of the calibration by " << scale;
  return text.str();
}

// Moves an image that was read to `image`, unless it can't be read or has another size than
// `camera`; `problem` says which.
template <typename Picture>
Status Take(const PictureSource& source,
            const PinholeCamera& camera,
            StatusOr<Picture> read,
            Picture* image,
            FrameProblem* problem) {
  *problem = FrameProblem::kUnreadable;
  if (!read.ok()) return read.status();
  *problem = FrameProblem::kWrongSize;
  if (read->width() != camera.width || read->height() != camera.height) {
    return Status::Error(source.path + ": " + SizeText(read->width(), read->height()) +
                         ", expected " + SizeText(camera.width, camera.height) +
                         " as the camera has" + ScaleHint(camera, read->width(), read->height()));
  }
  *problem = FrameProblem::kNone;
  *image = std::move(*read);
  return Status::Ok();
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
    if (!entry.color.empty()) return true;
  }
  return false;
}

const StereoRig* DepthSequence::rig() const {
  return listing_->rig.has_value() ? &*listing_->rig : nullptr;
}

bool DepthSequence::is_rectified() const { return listing_->is_rectified; }

Status DepthSequence::LoadDepth(const SequenceEntry& entry,
                                DepthFrame* frame,
                                FrameProblem* problem) const {
  DepthImage* const depth = &frame->depth;
  StatusOr<DepthImage> read = ReadDepth(entry.depth, depth_units_per_metre(), &frame->saturated);
  Status status = Take(entry.depth, camera(), std::move(read), depth, problem);
  if (!status.ok() || entry.mask.empty()) return status;
  MaskImage mask;
  status = Take(entry.mask, camera(), ReadMask(entry.mask, listing_->mask_meaning), &mask, problem);
  if (status.ok()) ApplyMask(mask, depth);
  return status;
}

Status DepthSequence::LoadPair(const SequenceEntry& entry,
                               DepthFrame* frame,
                               FrameProblem* problem) const {
  const PinholeCamera& left = listing_->rig->left.pinhole;
  const PinholeCamera& right = listing_->rig->right.pinhole;
  Status status = Take(entry.color, left, ReadColor(entry.color), &frame->color, problem);
  if (!status.ok()) return status;
  status = Take(entry.right, right, ReadColor(entry.right), &frame->right, problem);
  if (!status.ok() || entry.mask.empty()) return status;
  return Take(
      entry.mask, left, ReadMask(entry.mask, listing_->mask_meaning), &frame->mask, problem);
}

// Depth is essential, colour is not: a frame is used even if its colour image is damaged.
Status DepthSequence::LoadColor(const SequenceEntry& entry,
                                DepthFrame* frame,
                                FrameProblem* problem) const {
  StatusOr<ColorImage> color = ReadColor(entry.color);
  if (!color.ok()) {
    frame->warning = color.status().message() + ": the frame is used without colour";
    return Status::Ok();
  }
  return Take(entry.color, camera(), std::move(color), &frame->color, problem);
}

StatusOr<DepthFrame> DepthSequence::Load(int i, FrameProblem* problem) const {
  const SequenceEntry& entry = this->entry(i);
  FrameProblem ignored = FrameProblem::kNone;
  if (problem == nullptr) problem = &ignored;
  *problem = FrameProblem::kNone;
  DepthFrame frame;
  frame.number = entry.number;
  frame.time_s = entry.time_s;
  const bool is_stereo = rig() != nullptr;
  Status status = is_stereo ? LoadPair(entry, &frame, problem) : LoadDepth(entry, &frame, problem);
  if (status.ok() && !is_stereo && !entry.color.empty()) {
    status = LoadColor(entry, &frame, problem);
  }
  if (!status.ok()) return status;
  return frame;
}

ColorImage DepthSequence::LoadPicture(int i) const {
  const SequenceEntry& entry = this->entry(i);
  if (entry.color.empty()) return {};
  const PinholeCamera& expected = rig() != nullptr ? rig()->left.pinhole : camera();
  DepthFrame frame;
  FrameProblem ignored = FrameProblem::kNone;
  const Status status = Take(entry.color, expected, ReadColor(entry.color), &frame.color, &ignored);
  return status.ok() ? std::move(frame.color) : ColorImage();
}

}  // namespace ceres_ed
