// live/NNNNNN.ply: the map in the camera frame of one frame.
#ifndef CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_
#define CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map that is written, in the camera frame, in metres.
struct LivePoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  int id = -1;
  int birth_frame = -1;
  // The position in the camera frame of the birth frame.
  Eigen::Vector3f birth_position = Eigen::Vector3f::Zero();
  // How certain the point is, in [0, 1], and the last frame in which the camera saw it.
  float stability = 0.0f;
  int last_seen = -1;
};

// Writes a binary PLY of element 'vertex' with float x y z, int id, int birth_frame and float bx by
// bz under a temporary name, and renames it. The error gives the system's reason.
Status WriteLiveCloud(const std::string& path, const std::vector<LivePoint>& points);

// All map points in one frame, and where they were first seen. The vectors have the same length.
struct LiveSnapshot {
  int frame = 0;
  // The positions in the camera frame of `frame`, in metres.
  std::vector<Eigen::Vector3d> points;
  // The number of each point. It is the same in every frame and never used for another point.
  std::vector<int> ids;
  // The frame in which each point was first seen, and its position in the camera frame of that
  // frame.
  std::vector<int> birth_frames;
  std::vector<Eigen::Vector3d> birth_points;
  // How certain each point is, and the last frame that saw it; empty if the file does not say so.
  std::vector<double> stabilities;
  std::vector<int> last_seen;

  std::size_t size() const { return points.size(); }
};

// Reads the live cloud `path` of `frame`. Errors name the file. They are those of LoadCloud(), and:
// a property of `id birth_frame bx by bz` is missing or of the wrong kind, or an id occurs twice.
// Points that are not finite are left out, with a sentence in `warnings`.
StatusOr<LiveSnapshot> ReadLiveCloud(const std::string& path,
                                     int frame,
                                     std::vector<std::string>* warnings);

// Returns "000012.ply" for frame 12.
std::string LiveCloudName(int frame);

// Returns whether a file of this name may be a live cloud.
bool IsLiveCloudName(const std::string& name);

// Returns the live clouds of a folder by frame: the files whose names are a number followed by
// ".ply". The result is empty if there is no such folder. It is an error if two files have the same
// number.
StatusOr<std::map<int, std::string>> ListLiveClouds(const std::string& folder);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_
