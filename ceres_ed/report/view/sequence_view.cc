#include "ceres_ed/report/view/sequence_view.h"

#include <ceres_ed/report/view/decimation.h>
#include <ceres_ed/report/view/number_text.h>
#include <ceres_ed/report/view/seen_points.h>
#include <ceres_ed/report/view/sequence_timeline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>

namespace ceres_ed {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr char kMillimetres[] = "mm";
constexpr double kMillimetresPerMetre = 1000.0;

// Builds the map that moves.
class MapBuilder {
 public:
  explicit MapBuilder(const SequenceParts& parts) : parts_(parts) {}

  ViewSurface Build();

 private:
  bool is_live() const { return !parts_.moments[0].cloud.points.empty(); }
  std::size_t count() const { return map_.rows.size(); }
  int num_moments() const { return static_cast<int>(parts_.moments.size()); }
  // Returns the value of a list of the map for each point that is shown; NaN for points that the
  // map has dropped.
  template <typename T>
  std::vector<double> OfMap(const std::vector<T>& values, double factor = 1.0) const;
  void ListKnown();
  void ChoosePoints();
  void FollowPoints();
  void FillGaps();
  void AppearWhenSeen();
  void AddField(const char* key, const char* name, const char* unit, std::vector<double> values);
  void AddLook();

  const SequenceParts& parts_;
  ViewSurface map_;
  // For each id: its place in the map, -1 for points that the map has dropped.
  std::unordered_map<int, int> in_map_;
  // All points that were ever there, and where they were when they were first seen in a moment.
  std::vector<int> ids_;
  std::vector<Eigen::Vector3d> places_;
  // The figures of all points and moments.
  std::vector<double> errors_, motions_, stabilities_;
};

void MapBuilder::ListKnown() {
  for (std::size_t i = 0; i < parts_.map.size(); ++i) {
    in_map_.emplace(parts_.map.ids[i], static_cast<int>(i));
    ids_.push_back(parts_.map.ids[i]);
    places_.push_back(parts_.map.points[i]);
  }
  for (const SequenceMoment& moment : parts_.moments) {
    const CameraPose& pose = parts_.map_from_camera.at(moment.frame);
    for (std::size_t i = 0; i < moment.cloud.size(); ++i) {
      if (!in_map_.emplace(moment.cloud.ids[i], -1).second) continue;
      ids_.push_back(moment.cloud.ids[i]);
      places_.push_back(pose * moment.cloud.points[i]);
    }
  }
}

// Chooses points of the map, and fewer of those that it has dropped.
void MapBuilder::ChoosePoints() {
  const auto split = static_cast<std::ptrdiff_t>(parts_.map.size());
  const std::vector<Eigen::Vector3d> kept(places_.begin(), places_.begin() + split);
  const std::vector<Eigen::Vector3d> dropped(places_.begin() + split, places_.end());
  for (const int i : Decimate(kept, {}, parts_.max_points).kept) map_.rows.push_back(ids_[i]);
  constexpr int kShareOfDropped = 6;
  const int most = std::max(1, parts_.max_points / kShareOfDropped);
  if (!dropped.empty()) {
    for (const int i : Decimate(dropped, {}, most).kept) map_.rows.push_back(ids_[split + i]);
  }
  map_.all_points = static_cast<int>(places_.size());
}

void MapBuilder::FollowPoints() {
  std::unordered_map<int, int> number;
  for (std::size_t i = 0; i < count(); ++i) number.emplace(map_.rows[i], static_cast<int>(i));
  PointMoments& moments = *map_.moments;
  const std::size_t size = count() * parts_.moments.size();
  moments.places.assign(size, Eigen::Vector3d::Constant(kNan));
  motions_.assign(size, kNan);
  stabilities_.assign(size, kNan);
  errors_.assign(size, kNan);
  for (int m = 0; m < num_moments(); ++m) {
    const SequenceMoment& moment = parts_.moments[m];
    const LiveSnapshot& cloud = moment.cloud;
    const CameraPose& pose = parts_.map_from_camera.at(moment.frame);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto found = number.find(cloud.ids[i]);
      if (found == number.end()) continue;
      const int point = found->second;
      const std::size_t at = static_cast<std::size_t>(m) * count() + point;
      moments.places[at] = pose * cloud.points[i];
      moments.first[point] = std::min(moments.first[point], m);
      moments.last[point] = std::max(moments.last[point], m);
      const auto birth = parts_.map_from_camera.find(cloud.birth_frames[i]);
      if (birth != parts_.map_from_camera.end()) {
        motions_[at] = kMillimetresPerMetre *
                       (moments.places[at] - birth->second * cloud.birth_points[i]).norm();
      }
      if (!cloud.stabilities.empty()) stabilities_[at] = cloud.stabilities[i];
      if (!moment.errors.empty()) errors_[at] = kMillimetresPerMetre * moment.errors[i];
    }
  }
  FillGaps();
}

// Gives each point a place in all moments: where it was last, or before its first moment where it
// was then. Points of the map that no moment has are there from the last moment on.
void MapBuilder::FillGaps() {
  PointMoments& moments = *map_.moments;
  for (std::size_t i = 0; i < count(); ++i) {
    const auto place = [&](int m) -> Eigen::Vector3d& {
      return moments.places[static_cast<std::size_t>(m) * count() + i];
    };
    if (moments.last[i] < 0) {
      moments.first[i] = moments.last[i] = num_moments() - 1;
      place(moments.first[i]) = parts_.map.points[in_map_.at(map_.rows[i])];
    }
    for (int m = 0; m < moments.first[i]; ++m) place(m) = place(moments.first[i]);
    for (int m = moments.first[i] + 1; m < num_moments(); ++m) {
      if (std::isnan(place(m).x())) place(m) = place(m - 1);
    }
  }
}

void MapBuilder::AppearWhenSeen() {
  PointMoments& moments = *map_.moments;
  for (std::size_t i = 0; i < count(); ++i) {
    const int birth = parts_.map.birth_frames[in_map_.at(map_.rows[i])];
    const auto at = std::lower_bound(
        parts_.moments.begin(),
        parts_.moments.end(),
        birth,
        [](const SequenceMoment& moment, int frame) { return moment.frame < frame; });
    const int first = static_cast<int>(at - parts_.moments.begin());
    moments.first[i] = std::min(first, num_moments() - 1);
    moments.last[i] = num_moments() - 1;
  }
}

template <typename T>
std::vector<double> MapBuilder::OfMap(const std::vector<T>& values, double factor) const {
  std::vector<double> of_points;
  if (values.size() != parts_.map.size()) return of_points;
  for (const int id : map_.rows) {
    const int i = in_map_.at(id);
    of_points.push_back(i < 0 ? kNan : factor * static_cast<double>(values[i]));
  }
  return of_points;
}

void MapBuilder::AddField(const char* key,
                          const char* name,
                          const char* unit,
                          std::vector<double> values) {
  const bool is_known =
      std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (!is_known) return;
  ScalarField field;
  field.key = key;
  field.name = name;
  field.unit = unit;
  field.values = std::move(values);
  map_.fields.push_back(std::move(field));
}

// Adds the colours and normals that the map has at its end.
void MapBuilder::AddLook() {
  for (const int id : map_.rows) {
    const int i = in_map_.at(id);
    if (parts_.has_color) map_.colors.push_back(i < 0 ? kUnknownColor : parts_.map.colors[i]);
    map_.normals.push_back(i < 0 ? Eigen::Vector3d(0.0, 0.0, 0.0) : parts_.map.normals[i]);
  }
}

ViewSurface MapBuilder::Build() {
  map_.name = "map";
  ListKnown();
  ChoosePoints();
  map_.moments.emplace();
  map_.moments->count = num_moments();
  map_.moments->first.assign(count(), num_moments());
  map_.moments->last.assign(count(), -1);
  if (is_live()) {
    FollowPoints();
    map_.points.assign(map_.moments->places.end() - static_cast<std::ptrdiff_t>(count()),
                       map_.moments->places.end());
  } else {
    AppearWhenSeen();
    for (const int id : map_.rows) map_.points.push_back(parts_.map.points[in_map_.at(id)]);
  }
  AddField("truth", "distance to the true place", kMillimetres, std::move(errors_));
  AddField(
      "motion", "motion of the tissue since it was first seen", kMillimetres, std::move(motions_));
  AddField("stability",
           "stability",
           "0 to 1",
           stabilities_.empty() ? OfMap(parts_.map.stabilities) : std::move(stabilities_));
  AddField("last_seen", "last frame that saw the point", "frame", OfMap(parts_.map.last_seen));
  AddField("first_seen", "first frame that saw the point", "frame", OfMap(parts_.map.birth_frames));
  std::vector<double> deviations = OfMap(parts_.std_dev, kMillimetresPerMetre);
  for (double& deviation : deviations) deviation = deviation >= 0.0 ? deviation : kNan;
  AddField("std_dev", "standard deviation (uncertainty)", kMillimetres, std::move(deviations));
  AddLook();
  std::vector<Eigen::Vector3d> there;
  for (std::size_t i = 0; i < count(); ++i) {
    if (map_.IsThere(static_cast<int>(i), 1.0)) there.push_back(map_.points[i]);
  }
  map_.spacing = MedianSpacing(there);
  return std::move(map_);
}

}  // namespace

std::vector<int> ChooseMoments(const std::vector<int>& frames, int most) {
  const auto count = static_cast<int>(frames.size());
  if (count <= most) return frames;
  std::vector<int> chosen;
  for (int i = 0; i < most; ++i) {
    const double at = static_cast<double>(i) * (count - 1) / std::max(1, most - 1);
    chosen.push_back(frames[std::lround(at)]);
  }
  return chosen;
}

ColorImage ShrinkPicture(const ColorImage& picture, int width) {
  const int factor = (picture.width() + width - 1) / width;
  if (factor <= 1) return picture;
  ColorImage small(picture.width() / factor, picture.height() / factor);
  for (int v = 0; v < small.height(); ++v) {
    for (int u = 0; u < small.width(); ++u) {
      std::array<int, 3> sum = {0, 0, 0};
      for (int y = 0; y < factor; ++y) {
        for (int x = 0; x < factor; ++x) {
          const Rgb& pixel = picture(factor * u + x, factor * v + y);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        small(u, v)[c] = static_cast<std::uint8_t>(sum[c] / (factor * factor));
      }
    }
  }
  return small;
}

Scene MakeSequenceScene(const SequenceParts& parts) {
  Scene scene;
  scene.surfaces.push_back(MapBuilder(parts).Build());
  scene.panels.push_back({"Map", 0, -1.0, true, true});
  scene.timeline = MakeTimeline(parts, scene.surfaces[0].rows);
  // From behind the first camera, above it and beside it.
  ViewCamera camera;
  camera.from = Eigen::Vector3d(0.5, -0.45, -1.0).normalized();
  camera.up = -Eigen::Vector3d::UnitY();
  scene.camera = camera;
  SetRanges(&scene);
  const ViewSurface& map = scene.surfaces[0];
  if (map.Find("truth") != nullptr) {
    scene.first_field = "truth";
  } else if (!map.colors.empty()) {
    scene.first_field = kOwnColors;
  } else if (!map.fields.empty()) {
    scene.first_field = map.fields[0].key;
  }
  return scene;
}

}  // namespace ceres_ed
