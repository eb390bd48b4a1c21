#include "ceres_ed/report/view/sequence_timeline.h"

#include <ceres_ed/report/view/decimation.h>
#include <ceres_ed/report/view/number_text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace ceres_ed {
namespace {

// A figure of a frame in words: a column of frames.csv, its name, factor and unit.
struct FrameFigure {
  const char* column;
  const char* name;
  double factor;
  const char* unit;
};

constexpr double kPercent = 100.0;
constexpr double kMilli = 1000.0;

constexpr FrameFigure kFigures[] = {{"rms_plane", "residual", kMilli, " mm"},
                                    {"t_total", "time", kMilli, " ms"},
                                    {"nodes", "nodes", 1.0, ""},
                                    {"map_points", "map points", 1.0, ""},
                                    {"explained", "explained", kPercent, " %"},
                                    {"overlap", "overlap", kPercent, " %"},
                                    {"weak_directions", "weak directions", 1.0, ""}};

std::string TextOfFrame(const FrameLog& log, std::size_t row) {
  std::string text = "Frame " + std::to_string(log.frames[row]) + ": " + log.statuses[row];
  for (const FrameFigure& figure : kFigures) {
    const std::vector<double>* const column = log.Find(figure.column);
    if (column == nullptr || !std::isfinite((*column)[row])) continue;
    text += std::string("; ") + figure.name + " " + ShortNumber(figure.factor * (*column)[row]) +
            figure.unit;
  }
  return text + ".";
}

// Returns where a point of the camera frame is in a picture of `width` pixels across, or nothing.
std::optional<Eigen::Vector2d> PixelIn(const PinholeCamera& camera,
                                       const Eigen::Vector3d& point,
                                       const ColorImage& picture) {
  if (!(point.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d pixel = camera.Project(point);
  const bool is_inside = pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= camera.width - 1 &&
                         pixel.y() <= camera.height - 1;
  if (!is_inside) return std::nullopt;
  const double factor = static_cast<double>(picture.width()) / camera.width;
  return Eigen::Vector2d(factor * pixel);
}

class TimelineBuilder {
 public:
  TimelineBuilder(const SequenceParts& parts, const std::vector<int>& ids)
      : parts_(parts), ids_(ids) {}

  Timeline Build();

 private:
  void AddFrames();
  void AddMoments();
  void AddTracks();
  // Marks map points that the camera sees, a few of them.
  void MarkMapPoints();

  const SequenceParts& parts_;
  const std::vector<int>& ids_;
  Timeline timeline_;
};

void TimelineBuilder::AddFrames() {
  const FrameLog& log = parts_.log;
  const auto add = [this](int number, const std::string& status, const std::string& text) {
    TimelineFrame frame = {number, status, text, std::nullopt};
    const auto pose = parts_.map_from_camera.find(number);
    if (pose != parts_.map_from_camera.end()) frame.map_from_camera = pose->second;
    timeline_.frames.push_back(std::move(frame));
  };
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    add(log.frames[i], log.statuses[i], TextOfFrame(log, i));
  }
  if (!log.frames.empty()) return;
  for (const auto& [number, pose] : parts_.map_from_camera) {
    add(number, "tracked", "Frame " + std::to_string(number) + ".");
  }
}

void TimelineBuilder::AddMoments() {
  std::map<int, int> row;
  for (std::size_t i = 0; i < timeline_.frames.size(); ++i) {
    row.emplace(timeline_.frames[i].number, static_cast<int>(i));
  }
  for (const SequenceMoment& moment : parts_.moments) {
    timeline_.moments.push_back(row.at(moment.frame));
    timeline_.pictures.push_back({ShrinkPicture(moment.picture), {}});
  }
}

void TimelineBuilder::AddTracks() {
  std::map<int, int> moment_of_frame;
  for (std::size_t m = 0; m < parts_.moments.size(); ++m) {
    moment_of_frame.emplace(parts_.moments[m].frame, static_cast<int>(m));
  }
  std::map<int, ViewTrack> tracks;
  for (const TrackPlace& place : parts_.tracks) {
    const auto moment = moment_of_frame.find(place.frame);
    const auto pose = parts_.map_from_camera.find(place.frame);
    if (moment == moment_of_frame.end() || pose == parts_.map_from_camera.end()) continue;
    ViewTrack& track = tracks[place.id];
    track.id = place.id;
    track.moments.push_back(moment->second);
    track.places.push_back(pose->second * place.in_camera);
    ViewPicture& picture = timeline_.pictures[moment->second];
    const auto pixel = PixelIn(parts_.camera, place.in_camera, picture.image);
    if (place.visible && pixel && !picture.image.empty())
      picture.marks.push_back({place.id, *pixel});
  }
  for (auto& [id, track] : tracks) timeline_.tracks.push_back(std::move(track));
}

void TimelineBuilder::MarkMapPoints() {
  constexpr int kMarks = 150;
  // Points that are well apart in the last map.
  std::set<int> shown(ids_.begin(), ids_.end());
  std::vector<int> ids;
  std::vector<Eigen::Vector3d> places;
  for (std::size_t i = 0; i < parts_.map.size(); ++i) {
    if (shown.count(parts_.map.ids[i]) == 0) continue;
    ids.push_back(parts_.map.ids[i]);
    places.push_back(parts_.map.points[i]);
  }
  std::set<int> chosen;
  for (const int i : Decimate(places, {}, kMarks).kept) chosen.insert(ids[i]);
  for (std::size_t m = 0; m < parts_.moments.size(); ++m) {
    const LiveSnapshot& cloud = parts_.moments[m].cloud;
    ViewPicture& picture = timeline_.pictures[m];
    if (picture.image.empty() || cloud.last_seen.empty()) continue;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (chosen.count(cloud.ids[i]) == 0 || cloud.last_seen[i] != cloud.frame) continue;
      const auto pixel = PixelIn(parts_.camera, cloud.points[i], picture.image);
      if (pixel) picture.marks.push_back({cloud.ids[i], *pixel});
    }
  }
}

Timeline TimelineBuilder::Build() {
  timeline_.camera = parts_.camera;
  AddFrames();
  AddMoments();
  AddTracks();
  if (timeline_.tracks.empty()) MarkMapPoints();
  timeline_.marks = timeline_.tracks.empty()
                        ? "points of the map that this frame sees, some of them"
                        : "points of --track that are visible";
  return std::move(timeline_);
}

}  // namespace

Timeline MakeTimeline(const SequenceParts& parts, const std::vector<int>& ids) {
  return TimelineBuilder(parts, ids).Build();
}

}  // namespace ceres_ed
