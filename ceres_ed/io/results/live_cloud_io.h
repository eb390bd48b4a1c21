// live/NNNNNN.ply: the map as a camera has it in one frame.
#ifndef CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_
#define CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map to write, camera frame, metres.
struct LivePoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  int id = -1;
  int birth_frame = -1;
  // In the camera frame of that frame.
  Eigen::Vector3f birth_position = Eigen::Vector3f::Zero();
};

// Returns ok when `path` is a binary PLY of element 'vertex' with float x y z, int id, int
// birth_frame and float bx by bz, written under a temporary name and renamed; else an error with
// the system's reason.
Status WriteLiveCloud(const std::string& path, const std::vector<LivePoint>& points);

// Every map point as it is in `frame`, and where it came from; the vectors are of one length.
struct LiveSnapshot {
  int frame = 0;
  // Camera frame of `frame`, metres.
  std::vector<Eigen::Vector3d> points;
  // The name of each point, the same in every frame and never given to another.
  std::vector<int> ids;
  // The frame that each point was first seen in, and where it was in the camera frame of that one.
  std::vector<int> birth_frames;
  std::vector<Eigen::Vector3d> birth_points;

  std::size_t size() const { return points.size(); }
};

// Returns the live cloud `path` of `frame`. Errors name the file: as of LoadCloud, a property of
// `id birth_frame bx by bz` that is missing or of the wrong kind, an id that is there twice. Points
// that are not finite are left out, with a sentence in `warnings`.
StatusOr<LiveSnapshot> ReadLiveCloud(const std::string& path,
                                     int frame,
                                     std::vector<std::string>* warnings);

// "000012.ply" for frame 12.
std::string LiveCloudName(int frame);

// Returns whether a file of this name may be a live cloud.
bool IsLiveCloudName(const std::string& name);

// Returns the live clouds of a folder by frame: the files whose names are a number and end in
// ".ply"; none where there is no such folder. Error: two files have one number.
StatusOr<std::map<int, std::string>> ListLiveClouds(const std::string& folder);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_
