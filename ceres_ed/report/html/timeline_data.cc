#include "ceres_ed/report/html/timeline_data.h"

#include <ceres_ed/report/html/base64.h>
#include <ceres_ed/report/picture/jpeg.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

std::string PosesData(const std::vector<TimelineFrame>& frames) {
  constexpr int kNumbers = 7;
  std::vector<double> numbers;
  for (const TimelineFrame& frame : frames) {
    if (!frame.map_from_camera) {
      numbers.insert(numbers.end(), kNumbers, std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const CameraPose& pose = *frame.map_from_camera;
    const Eigen::Quaterniond& q = pose.rotation;
    numbers.insert(numbers.end(), pose.translation.begin(), pose.translation.end());
    numbers.insert(numbers.end(), {q.w(), q.x(), q.y(), q.z()});
  }
  return Base64OfDoubles(numbers);
}

ordered_json PictureData(const ViewPicture& picture) {
  const std::string jpeg = EncodeJpeg(picture.image);
  if (jpeg.empty()) return nullptr;
  ordered_json data = {{"jpeg", Base64(jpeg)},
                       {"width", picture.image.width()},
                       {"height", picture.image.height()},
                       {"ids", ordered_json::array()},
                       {"pixels", ordered_json::array()}};
  for (const PictureMark& mark : picture.marks) {
    constexpr double kTenth = 10.0;
    data["ids"].push_back(mark.id);
    for (const double coordinate : mark.pixel) {
      data["pixels"].push_back(std::round(kTenth * coordinate) / kTenth);
    }
  }
  return data;
}

}  // namespace

ordered_json TimelineData(const Timeline& timeline) {
  const PinholeCamera& c = timeline.camera;
  ordered_json data = {{"frames", ordered_json::array()},
                       {"moments", timeline.moments},
                       {"poses", PosesData(timeline.frames)},
                       {"camera",
                        {{"fx", c.fx},
                         {"fy", c.fy},
                         {"cx", c.cx},
                         {"cy", c.cy},
                         {"width", c.width},
                         {"height", c.height}}},
                       {"pictures", ordered_json::array()},
                       {"tracks", ordered_json::array()}};
  for (const TimelineFrame& frame : timeline.frames) {
    data["frames"].push_back(
        {{"number", frame.number}, {"status", frame.status}, {"text", frame.text}});
  }
  for (const ViewPicture& picture : timeline.pictures) {
    data["pictures"].push_back(PictureData(picture));
  }
  for (const ViewTrack& track : timeline.tracks) {
    std::vector<double> places;
    for (const Eigen::Vector3d& place : track.places) {
      places.insert(places.end(), place.begin(), place.end());
    }
    data["tracks"].push_back(
        {{"id", track.id}, {"moments", track.moments}, {"places", Base64OfDoubles(places)}});
  }
  return data;
}

}  // namespace ceres_ed
