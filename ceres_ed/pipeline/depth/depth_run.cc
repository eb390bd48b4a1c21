#include "ceres_ed/pipeline/depth/depth_run.h"

#include <ceres_ed/io/sequence/native_writer.h>
#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/stereo/depth_source.h>
#include <ceres_ed/util/statistics.h>
#include <ceres_ed/util/timer.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// Returns the depth of the pixels that have one.
std::vector<double> Measured(const DepthImage& depth) {
  std::vector<double> measured;
  for (const float z : depth.pixels()) {
    if (z > 0.0F) measured.push_back(static_cast<double>(z));
  }
  return measured;
}

// Returns the largest power of ten of units in a metre with which twice the depth of nearly all
// pixels fits into 16 bits.
double ChooseUnits(const DepthImage& depth) {
  constexpr double kLargest = 65534.0;
  constexpr double kFinest = 1e6;
  constexpr double kUsual = 1e4;
  std::vector<double> measured = Measured(depth);
  if (measured.empty()) return kUsual;
  const auto rank = measured.begin() + static_cast<std::ptrdiff_t>(0.99 * (measured.size() - 1.0));
  std::nth_element(measured.begin(), rank, measured.end());
  return std::min(kFinest, std::pow(10.0, std::floor(std::log10(kLargest / (2.0 * *rank)))));
}

// The run: what is read, what is written, and what is known of the frames so far.
class DepthRun {
 public:
  DepthRun(const DepthSettings& settings, const DepthSource& source, DepthObserver* observer)
      : settings_(settings), source_(source), observer_(observer) {}

  Outcome Run() {
    const Timer clock;
    const int total = source_.num_frames();
    int done = 0;
    for (; done < total && !observer_->ShouldStop(); ++done) {
      Outcome outcome = TakeFrame(done);
      if (!outcome.done()) return outcome;
      char note[64];
      std::snprintf(note, sizeof(note), "frames, %.1f a second", (done + 1) / clock.Seconds());
      observer_->OnProgress(done + 1, total, note);
    }
    if (writer_ == nullptr && done == total) {
      return Outcome::NoResult(Status::Error(settings_.input + ": none of its " +
                                             std::to_string(total) +
                                             " frames could be read, expected at least one"));
    }
    if (writer_ != nullptr) {
      Status status = writer_->Close();
      if (status.ok()) status = CopyTruth();
      if (status.ok()) status = WriteInfo();
      if (!status.ok()) return Outcome::BadInput(status);
      observer_->OnEnd(Summary());
    }
    if (done == total) return Outcome::Done();
    return Outcome::StoppedEarly("stopped at frame " + std::to_string(done) + " of " +
                                 std::to_string(total) + "; the frames in " + settings_.output +
                                 " are complete");
  }

 private:
  Outcome TakeFrame(int index) {
    FrameProblem problem = FrameProblem::kNone;
    const StatusOr<DepthFrame> frame = source_.Load(index, &problem);
    if (!frame.ok()) {
      if (problem == FrameProblem::kWrongSize) return Outcome::BadInput(frame.status());
      observer_->OnWarning(frame.status().message() + ": frame skipped");
      ++skipped_;
      return Outcome::Done();
    }
    if (writer_ == nullptr) {
      Status status = Open(frame->depth);
      if (!status.ok()) return Outcome::BadInput(status);
    }
    FrameToWrite native;
    native.number = frame->number;
    native.depth = &frame->depth;
    native.color = &frame->color;
    native.mask = &frame->mask;
    const CameraPose* const pose = source_.given_pose(index);
    native.has_pose = pose != nullptr;
    if (pose != nullptr) native.world_from_camera = *pose;
    Status status = writer_->WriteFrame(native);
    if (!status.ok()) return Outcome::BadInput(status);
    std::vector<double> measured = Measured(frame->depth);
    const double pixels = static_cast<double>(frame->depth.pixels().size());
    valid_shares_.push_back(source_.is_stereo() ? frame->valid_share
                                                : static_cast<double>(measured.size()) / pixels);
    if (!measured.empty()) depths_.push_back(Median(std::move(measured)));
    if (source_.is_stereo()) seconds_.push_back(frame->stereo_s);
    return Outcome::Done();
  }

  Status Open(const DepthImage& first) {
    SequenceWriterOptions options;
    options.camera.camera = source_.camera();
    options.camera.depth_units_per_metre = settings_.units_per_metre;
    if (settings_.units_per_metre == 0.0) {
      options.camera.depth_units_per_metre = ChooseUnits(first);
    }
    options.overwrite = settings_.overwrite;
    units_ = options.camera.depth_units_per_metre;
    StatusOr<std::unique_ptr<NativeSequenceWriter>> writer =
        NativeSequenceWriter::Create(settings_.output, options);
    if (!writer.ok()) return writer.status();
    writer_ = *std::move(writer);
    return Status::Ok();
  }

  // The truth is in the world frame, which stays the same. Tracks are in pixels of the left
  // picture.
  Status CopyTruth() const {
    std::vector<const char*> names = {kTruthMeshName, kTruthVerticesName};
    if (!source_.is_stereo() || source_.sequence().is_rectified()) names.push_back("tracks_2d.csv");
    for (const char* name : names) {
      const fs::path from = fs::path(settings_.input) / name;
      std::error_code error;
      if (!fs::is_regular_file(from, error)) continue;
      const fs::path to = fs::path(settings_.output) / name;
      fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
      if (error) return Status::Error(to.string() + ": can't be written: " + error.message());
    }
    return Status::Ok();
  }

  WrittenDepth Summary() const {
    WrittenDepth summary;
    summary.frames = writer_->num_frames();
    summary.skipped = skipped_;
    summary.width = source_.camera().width;
    summary.height = source_.camera().height;
    summary.units_per_metre = units_;
    summary.valid_share = InterpolatedMedian(valid_shares_);
    summary.depth = InterpolatedMedian(depths_);
    summary.stereo_s =
        seconds_.empty() ? std::numeric_limits<double>::quiet_NaN() : InterpolatedMedian(seconds_);
    return summary;
  }

  Status WriteInfo() const {
    const WrittenDepth summary = Summary();
    nlohmann::ordered_json info = {{"program", "ed_depth"},
                                   {"version", kVersion},
                                   {"sequence", source_.description()},
                                   {"frames", summary.frames},
                                   {"skipped", summary.skipped},
                                   {"valid_share", summary.valid_share},
                                   {"depth_median_m", summary.depth}};
    if (source_.is_stereo()) {
      const RectifiedRig& rig = *source_.rig();
      info["baseline_m"] = rig.baseline;
      info["disparity_of_infinity"] = rig.offset;
      const Eigen::Quaterniond& q = rig.rectified_from_left.rotation;
      info["rectified_from_left"] = {{"qx", q.x()}, {"qy", q.y()}, {"qz", q.z()}, {"qw", q.w()}};
      info["stereo_s"] = summary.stereo_s;
      info["disparity_sigma"] = settings_.stereo.disparity_sigma;
      info["noise"] = "sigma_z = z^2 / (fx baseline) disparity_sigma";
    }
    nlohmann::ordered_json flags = FlagsReport(settings_.flags);
    for (const char* name : {"output", "overwrite", "quiet"}) flags.erase(name);
    info["flags"] = flags;
    return WriteReport(settings_.output + "/info.json", info);
  }

  const DepthSettings& settings_;
  const DepthSource& source_;
  DepthObserver* observer_;
  // Null before the first frame.
  std::unique_ptr<NativeSequenceWriter> writer_;
  double units_ = 0.0;
  int skipped_ = 0;
  // Of each frame.
  std::vector<double> valid_shares_, depths_, seconds_;
};

}  // namespace

Outcome RunDepth(const DepthSettings& settings, DepthObserver* observer) {
  if (IsFolderOfSequence(settings.output, settings.input)) {
    return Outcome::Usage("--output=" + settings.output +
                          " is a folder of the sequence, expected another one");
  }
  if (!settings.overwrite && HoldsNativeSequence(settings.output)) {
    return Outcome::BadInput(Status::Error(
        settings.output + ": holds a sequence already, expected an empty folder or --overwrite"));
  }
  const StatusOr<std::unique_ptr<DepthSource>> source =
      OpenDepthSource(settings.input, settings.sequence, settings.stereo);
  if (!source.ok()) return Outcome::BadInput(source.status());
  observer->OnNote((*source)->description());
  for (const std::string& warning : (*source)->warnings()) observer->OnWarning(warning);
  return DepthRun(settings, **source, observer).Run();
}

}  // namespace ceres_ed
