#include "ceres_ed/pipeline/slam/slam_session.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/pipeline/slam/slam_report.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>

namespace ceres_ed {
namespace {

// Returns the FNV-1a hash of the depth, which distinguishes sequences of the same camera.
std::string Fingerprint(const DepthImage& depth) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const float z : depth.pixels()) {
    std::uint32_t bits;
    std::memcpy(&bits, &z, sizeof(bits));
    hash = (hash ^ bits) * 1099511628211ull;
  }
  return std::to_string(hash);
}

// Returns the first line of `now` that differs from `before`, and the line that was expected. The
// texts have one flag in each line.
std::string FirstDifference(const std::string& now, const std::string& before) {
  std::istringstream now_lines(now), before_lines(before);
  std::string a, b;
  while (std::getline(now_lines, a)) {
    if (!std::getline(before_lines, b)) return a + ", expected no such flag";
    if (a != b) return a + ", expected " + b;
  }
  return std::getline(before_lines, b) ? "one flag less, expected " + b : "the same flags";
}

// Returns the pixels with a depth that is not that of a tool: they are 1, all others 0.
MaskImage TissueMask(const DepthImage& depth, const DeformableSlam& slam) {
  MaskImage mask = slam.ForegroundMask();
  if (mask.empty()) mask = MaskImage(depth.width(), depth.height(), 0);
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    mask.pixels()[i] = mask.pixels()[i] == 0 && depth.pixels()[i] > 0.0F ? 1 : 0;
  }
  return mask;
}

}  // namespace

Outcome SlamSession::Start(std::vector<NamedPoint> points) {
  points_ = std::move(points);
  const std::string path = settings_.output + "/" + kCheckpointName;
  if (settings_.resume && std::filesystem::exists(path)) return Resume(path);
  if (settings_.resume) {
    observer_->OnNote("no " + path + " yet, starting with the first frame");
  }
  StatusOr<std::unique_ptr<SlamOutput>> output =
      SlamOutput::Create(settings_.output, sequence_.camera());
  if (!output.ok()) return Outcome::BadInput(output.status());
  output_ = *std::move(output);
  return Outcome::Done();
}

Outcome SlamSession::Run() { return End(TakeFrames()); }

Outcome SlamSession::TakeFrames() {
  const int total = sequence_.num_frames();
  const Timer timer;
  const int start = next_;
  while (next_ < total) {
    Outcome outcome = TakeFrame();
    if (!outcome.done()) return outcome;
    const double rate = (next_ - start) / std::max(1e-9, timer.Seconds());
    observer_->OnFrame(records_.back(), next_, total, rate);
    if (settings_.checkpoint_every > 0 && next_ % settings_.checkpoint_every == 0) {
      const Status status = WriteCheckpoint();
      if (!status.ok()) return Outcome::BadInput(status);
    }
    if (next_ == total) break;
    if (observer_->ShouldStop()) {
      stop_status_ = "interrupted";
      return Outcome::StoppedEarly("interrupted");
    }
    if (clock_.Seconds() > settings_.time_limit_s) {
      stop_status_ = "time_limit";
      return Outcome::StoppedEarly("time limit reached");
    }
  }
  return Outcome::Done();
}

Outcome SlamSession::TakeFrame() {
  const int index = next_++;
  const Timer timer;
  const auto [frame, problem] = reader_.Read(index);
  FrameRecord record;
  record.number = sequence_.frame_number(index);
  record["t_load"] = timer.Seconds();
  record["t_stereo"] = record["valid_share"] = std::numeric_limits<double>::quiet_NaN();
  if (!frame.ok()) {
    if (problem == FrameProblem::kWrongSize) return Outcome::BadInput(frame.status());
    warnings_->Add("unreadable", frame.status().message() + ": frame skipped");
    depth_key_.clear();
  } else {
    if (!frame->warning.empty()) warnings_->Add("color", frame->warning);
    CheckDepth(*frame);
    if (frame->saturated > 0) {
      warnings_->Add("saturated",
                     "frame " + std::to_string(frame->number) + ": " +
                         std::to_string(frame->saturated) +
                         " pixels have the largest depth, 65535, and are left out");
    }
    Outcome outcome = Track(*frame, index, &record);
    NoteStereo(*frame, &record);
    if (!outcome.done()) return outcome;
  }
  records_.push_back(record);
  const Status status = output_->WriteRecord(record);
  return status.ok() ? Outcome::Done() : Outcome::BadInput(status);
}

void SlamSession::CheckDepth(const DepthFrame& frame) {
  depth_key_ = Fingerprint(frame.depth);
  const auto is_measured = [](float z) { return z > 0.0F; };
  const std::vector<float>& pixels = frame.depth.pixels();
  if (depth_checked_ || std::none_of(pixels.begin(), pixels.end(), is_measured)) return;
  depth_checked_ = true;
  const std::string warning =
      sequence_.is_stereo()
          ? StereoRangeWarning(frame.depth, sequence_.rig()->baseline)
          : DepthRangeWarning(frame.depth, sequence_.sequence().depth_units_per_metre());
  if (!warning.empty()) warnings_->Add("depth range", settings_.input + ": " + warning);
}

void SlamSession::NoteStereo(const DepthFrame& frame, FrameRecord* record) const {
  const bool is_stereo = sequence_.is_stereo();
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  (*record)["t_stereo"] = is_stereo ? frame.stereo_s : nothing;
  (*record)["valid_share"] = is_stereo ? frame.valid_share : nothing;
}

Outcome SlamSession::Track(const DepthFrame& frame, int index, FrameRecord* record) {
  const std::string name = "frame " + std::to_string(frame.number);
  // Prepare the input.
  SlamFrame input;
  input.number = frame.number;
  input.depth = &frame.depth;
  input.color = &frame.color;
  input.noise = frame.noise;
  if (settings_.options.camera == CameraMode::kGiven) {
    input.world_from_camera = sequence_.given_pose(index);
    if (input.world_from_camera == nullptr) {
      warnings_->Add("pose", name + ": has no pose: frame skipped");
      return Outcome::Done();
    }
  }
  const bool live = settings_.live_every > 0 && index % settings_.live_every == 0;
  input.catch_up = live || !points_.empty() || tracked_.size() > 0;
  // Track the frame.
  Timer timer;
  const double load_s = (*record)["t_load"];
  const FrameReport report = slam_->Process(input);
  if (!report.fault.empty()) return Outcome::NoResult(Status::Error(name + ": " + report.fault));
  *record = MakeFrameRecord(report, *slam_);
  (*record)["t_load"] = load_s;
  (*record)["t_total"] = timer.Restart();
  // Report what went wrong.
  if (Is(*record, FrameStatus::kSkipped)) {
    warnings_->Add("empty", name + ": no depth that could be used: frame skipped");
  }
  if (Is(*record, FrameStatus::kLost)) {
    warnings_->Add("lost", name + ": the camera was not found: frame lost");
  }
  // Bind the points to follow to the first map.
  if (!points_.empty() && slam_->unit() > 0.0) {
    if (settings_.predict != Challenge::kNone) DropPointsOffTheMap();
    StatusOr<TrackedPoints> bound = TrackedPoints::Bind(points_, *slam_, sequence_.camera());
    if (!bound.ok()) {
      return Outcome::BadInput(Status::Error(settings_.track + ": " + bound.status().message()));
    }
    tracked_ = *std::move(bound);
    points_.clear();
  }
  // Write the files of the frame.
  FrameOutput options;
  options.time_s = sequence_.time_s(index);
  options.live = live;
  const MaskImage mask = settings_.write_masks ? TissueMask(frame.depth, *slam_) : MaskImage();
  options.mask = settings_.write_masks ? &mask : nullptr;
  options.tracked = tracked_.size() > 0 ? &tracked_ : nullptr;
  if (report.camera_covariance.has_value()) options.camera_covariance = &*report.camera_covariance;
  const Status status = output_->WriteFrame(*record, *slam_, options);
  (*record)["t_write"] = timer.Seconds();
  return status.ok() ? Outcome::Done() : Outcome::BadInput(status);
}

void SlamSession::DropPointsOffTheMap() {
  const auto is_off = [this](const NamedPoint& point) {
    const StatusOr<TrackedPoints> bound = TrackedPoints::Bind({point}, *slam_, sequence_.camera());
    if (!bound.ok()) {
      warnings_->Add("predict", bound.status().message() + "; it follows the nearest other point");
    }
    return !bound.ok();
  };
  points_.erase(std::remove_if(points_.begin(), points_.end(), is_off), points_.end());
}

Outcome SlamSession::End(Outcome outcome) {
  const bool tracked = slam_->unit() > 0.0;
  if (outcome.done() && !tracked) {
    outcome = Outcome::NoResult(
        Status::Error(settings_.input + ": none of its " + std::to_string(records_.size()) +
                      " frames could be used, expected depth in at least one"));
  }
  slam_->CatchUp();
  if (tracked) {
    for (const std::string& warning : IdleEnergyWarnings(registry_, slam_->IdleEnergies())) {
      warnings_->Add("energy", warning);
    }
  }
  SlamRun run = MakeRun();
  run.message = outcome.message;
  run.status = "failed";
  if (outcome.code == ExitCode::kStoppedEarly) {
    run.status = stop_status_;
    run.message += " after frame " + std::to_string(records_.back().number);
    outcome.message = run.message + ", results so far in " + settings_.output;
  }
  if (outcome.done()) {
    run.status = "done";
    run.message = "all frames processed";
  }
  const Status status = WriteResults(run);
  if (!status.ok()) return Outcome::BadInput(status);
  observer_->OnEnd(run);
  return outcome;
}

SlamRun SlamSession::MakeRun() const {
  SlamRun run;
  run.settings = &settings_;
  run.sequence = &sequence_;
  run.slam = slam_;
  run.records = &records_;
  run.warnings = &warnings_->sentences();
  run.total_s = seconds_before_ + clock_.Seconds();
  return run;
}

Status SlamSession::WriteResults(const SlamRun& run) const {
  if (slam_->unit() > 0.0) {
    Status status = output_->WriteMap(*slam_, settings_.options.covariance);
    if (!status.ok()) return status;
  }
  return WriteReport(output_->Path(kReportName), SlamReport(run));
}

Status SlamSession::WriteCheckpoint() {
  slam_->CatchUp();
  SlamRun run = MakeRun();
  run.status = "running";
  run.message = "after frame " + std::to_string(records_.back().number);
  Status status = WriteResults(run);
  if (!status.ok()) return status;
  CheckpointWriter writer;
  std::string flags = settings_.fixed_flags;
  writer.Text("flags", &flags);
  std::string strategy = settings_.strategy_flags;
  writer.Text("strategy", &strategy);
  writer.Value("next", &next_);
  std::string frames = FramesKey();
  writer.Text("frames_key", &frames);
  ExchangeProgress(&writer);
  output_->Save(&writer);
  // The checkpoint is written last, so that everything to which it refers exists.
  return WriteFileAtomically(output_->Path(kCheckpointName), writer.TakeBytes());
}

Outcome SlamSession::Resume(const std::string& path) {
  const auto bad = [&path](const Status& status) {
    return Outcome::BadInput(Status::Error(path + ": " + status.message()));
  };
  const StatusOr<std::string> bytes = ReadWholeFile(path);
  if (!bytes.ok()) return Outcome::BadInput(bytes.status());
  const StatusOr<std::unique_ptr<CheckpointReader>> reader = CheckpointReader::Open(*bytes);
  if (!reader.ok()) return bad(reader.status());
  CheckpointReader* archive = reader->get();
  std::string flags, frames, strategy;
  archive->Text("flags", &flags);
  archive->Text("strategy", &strategy);
  archive->Text("frames_key", &frames);
  archive->Value("next", &next_);
  if (!archive->status().ok()) return bad(archive->status());
  // Check that the checkpoint belongs to this run and this sequence.
  if (flags != settings_.fixed_flags) {
    return Outcome::Usage("--resume with " + FirstDifference(settings_.fixed_flags, flags) +
                          " as in " + path);
  }
  if (next_ < 1 || next_ > sequence_.num_frames()) {
    return bad(Status::Error("was written after " + std::to_string(next_) +
                             " frames, expected 1 to " + std::to_string(sequence_.num_frames()) +
                             " as in the sequence"));
  }
  const StatusOr<DepthFrame> last = sequence_.Load(next_ - 1);
  depth_key_ = last.ok() ? Fingerprint(last->depth) : "";
  if (frames != FramesKey()) {
    return bad(Status::Error("belongs to another sequence, expected " + settings_.input));
  }
  // Restore the state, and continue the files.
  ExchangeProgress(archive);
  if (!archive->status().ok()) return bad(archive->status());
  if (strategy != settings_.strategy_flags) {
    warnings_->Add("resume",
                   "continued after frame " + std::to_string(sequence_.frame_number(next_ - 1)) +
                       " with " + FirstDifference(settings_.strategy_flags, strategy) +
                       " for the same bytes as without the interruption");
  }
  if (tracked_.size() > 0) points_.clear();
  StatusOr<std::unique_ptr<SlamOutput>> output =
      SlamOutput::Reopen(settings_.output, sequence_.camera(), archive);
  if (!output.ok()) return Outcome::BadInput(output.status());
  output_ = *std::move(output);
  return Outcome::Done();
}

std::string SlamSession::FramesKey() const {
  const PinholeCamera& c = sequence_.camera();
  const double units = sequence_.sequence().depth_units_per_metre();
  std::string key;
  AppendNumbers({c.fx, c.fy, c.cx, c.cy, c.width * 1.0, c.height * 1.0, units}, &key);
  for (int i = 0; i < next_; ++i) AppendNumbers({sequence_.frame_number(i) * 1.0}, &key);
  return key + " " + depth_key_;
}

void SlamSession::ExchangeProgress(CheckpointArchive* archive) {
  int checked = depth_checked_ ? 1 : 0;
  double seconds = seconds_before_ + clock_.Seconds();
  archive->Value("depth_checked", &checked);
  archive->Value("seconds", &seconds);
  std::string warnings;
  for (const std::string& sentence : warnings_->sentences()) warnings += sentence + "\n";
  archive->Text("warnings", &warnings);
  ExchangeRecords(&records_, archive);
  tracked_.Exchange(archive);
  slam_->Exchange(archive);
  if (archive->saving() || !archive->status().ok()) return;
  depth_checked_ = checked != 0;
  seconds_before_ = seconds;
  const std::vector<std::string_view> sentences = SplitLines(warnings, '\n');
  warnings_->Restore({sentences.begin(), sentences.end()});
}

}  // namespace ceres_ed
