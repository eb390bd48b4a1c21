#include "ceres_ed/stereo/depth_source.h"

#include <ceres_ed/stereo/pair_check.h>
#include <ceres_ed/util/timer.h>

#include <cstdio>
#include <utility>

namespace ceres_ed {
namespace {

std::string Pixels(double number) {
  char text[48];
  std::snprintf(text, sizeof(text), "%.1f pixels", number);
  return text;
}

// Returns what is wrong with a pair; an empty string if nothing is.
std::string ProblemOf(const PairFindings& findings, bool is_rectified) {
  const std::string corners = " (" + std::to_string(findings.corners) + " corners)";
  if (findings.IsUnrectified()) {
    return "the rows of the left and the right picture do not correspond: they differ by " +
           Pixels(findings.row_error) + corners + ", expected " +
           (is_rectified
                ? "rectified pictures, or the calibration of both cameras with their distortion"
                : "the calibration of these pictures, with the transform from the left to the "
                  "right camera and not the other way round");
  }
  if (findings.IsSwapped()) {
    return "left and right are swapped: " +
           std::to_string(static_cast<int>(100.0 * findings.behind)) + " % of the corners" +
           corners +
           " have a negative disparity, expected the pictures of "
           "the left camera as left" +
           (is_rectified ? "" : ", and the transform from the left to the right camera");
  }
  return "";
}

}  // namespace

const PinholeCamera& DepthSource::camera() const {
  return is_stereo() ? matcher_->camera() : sequence_->camera();
}

const RectifiedRig* DepthSource::rig() const { return is_stereo() ? &matcher_->rig() : nullptr; }

const CameraPose* DepthSource::given_pose(int i) const {
  if (poses_.empty()) return sequence_->given_pose(i);
  const std::optional<CameraPose>& pose = poses_[static_cast<std::size_t>(i)];
  return pose.has_value() ? &*pose : nullptr;
}

std::string DepthSource::description() const { return sequence_->description(); }

Status DepthSource::CheckFirstPair(const std::string& name, bool refuse) {
  for (int i = 0; i < sequence_->num_frames(); ++i) {
    FrameProblem problem = FrameProblem::kNone;
    const StatusOr<DepthFrame> frame = sequence_->Load(i, &problem);
    if (problem == FrameProblem::kWrongSize) return frame.status();
    if (!frame.ok()) continue;
    const RectifiedPair pair = matcher_->Rectify(frame->color, frame->right, frame->mask);
    const PairFindings findings =
        CheckPair(GrayOf(pair.left), GrayOf(pair.right), pair.left_mask, matcher_->rig().offset);
    const std::string where = name + ": frame " + std::to_string(frame->number) + ": ";
    const std::string sentence = ProblemOf(findings, sequence_->is_rectified());
    if (!sentence.empty() && refuse) return Status::Error(where + sentence);
    if (!sentence.empty()) {
      warnings_.push_back(where + sentence);
    } else if (findings.IsRough()) {
      warnings_.push_back(where + "the rows of the left and the right picture differ by " +
                          Pixels(findings.row_error) +
                          ", expected less than 1: the calibration is not exact, and depth may be "
                          "missing or wrong");
    }
    break;
  }
  return Status::Ok();
}

StatusOr<std::unique_ptr<DepthSource>> DepthSource::Create(std::unique_ptr<DepthSequence> sequence,
                                                           const std::string& name,
                                                           const StereoOptions& options) {
  std::unique_ptr<DepthSource> source(new DepthSource);
  source->sequence_ = std::move(sequence);
  const DepthSequence& pictures = *source->sequence_;
  source->warnings_ = pictures.warnings();
  if (pictures.rig() == nullptr) return StatusOr<std::unique_ptr<DepthSource>>(std::move(source));
  StatusOr<std::unique_ptr<StereoMatcher>> matcher =
      StereoMatcher::Create(*pictures.rig(), pictures.is_rectified(), options);
  if (!matcher.ok()) return Status::Error(name + ": " + matcher.status().message());
  source->matcher_ = *std::move(matcher);
  if (!pictures.is_rectified()) {
    const RigidTransform left_from_rectified =
        source->matcher_->rig().rectified_from_left.Inverse();
    for (int i = 0; i < pictures.num_frames(); ++i) {
      const CameraPose* const pose = pictures.given_pose(i);
      std::optional<CameraPose>& turned = source->poses_.emplace_back();
      if (pose != nullptr) turned = *pose * left_from_rectified;
    }
  }
  Status status = source->CheckFirstPair(name, options.check);
  if (!status.ok()) return status;
  return StatusOr<std::unique_ptr<DepthSource>>(std::move(source));
}

StatusOr<DepthFrame> DepthSource::LoadPictures(int i, FrameProblem* problem) const {
  return sequence_->Load(i, problem);
}

StatusOr<DepthFrame> DepthSource::Load(int i, FrameProblem* problem) const {
  return FindDepth(LoadPictures(i, problem));
}

StatusOr<DepthFrame> DepthSource::FindDepth(StatusOr<DepthFrame> pictures) const {
  StatusOr<DepthFrame> frame = std::move(pictures);
  if (!frame.ok() || !is_stereo()) return frame;
  const Timer timer;
  StereoDepth found = matcher_->Match(frame->color, frame->right, frame->mask);
  frame->depth = std::move(found.depth);
  frame->color = std::move(found.left);
  frame->right = ColorImage();
  if (!frame->mask.empty() || !sequence_->is_rectified()) frame->mask = std::move(found.mask);
  frame->noise = matcher_->noise();
  frame->valid_share = found.valid_share;
  frame->stereo_s = timer.Seconds();
  return frame;
}

ColorImage DepthSource::LoadPicture(int i) const {
  ColorImage picture = sequence_->LoadPicture(i);
  if (picture.empty() || !is_stereo()) return picture;
  return matcher_->Rectify(picture, picture, MaskImage()).left;
}

StatusOr<std::unique_ptr<DepthSource>> OpenDepthSource(const std::string& directory,
                                                       const SequenceOptions& options,
                                                       const StereoOptions& stereo) {
  StatusOr<std::unique_ptr<DepthSequence>> sequence = OpenSequence(directory, options);
  if (!sequence.ok()) return sequence.status();
  return DepthSource::Create(*std::move(sequence), directory, stereo);
}

}  // namespace ceres_ed
