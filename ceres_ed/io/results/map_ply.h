// map.ply: the map of a sequence.
#ifndef CERES_ED_IO_RESULTS_MAP_PLY_H_
#define CERES_ED_IO_RESULTS_MAP_PLY_H_

#include <ceres_ed/util/status.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The points of a map at one time, in metres. The vectors have the same length.
struct MapSnapshot {
  std::vector<Eigen::Vector3d> points;
  // Normals of unit length.
  std::vector<Eigen::Vector3d> normals;
  // Red, green and blue.
  std::vector<std::array<std::uint8_t, 3>> colors;
  // The numbers of the points. They are never used again for other points.
  std::vector<int> ids;
  // The frame in which each point was first seen.
  std::vector<int> birth_frames;
  // The number of observations in the running average of each point.
  std::vector<double> weights;
  // How certain each point is, in [0, 1], and the last frame in which the camera saw it.
  std::vector<double> stabilities;
  std::vector<int> last_seen;

  std::size_t size() const { return points.size(); }
};

// Writes the map, in the map frame, with the properties id, birth_frame, weight, stability and
// last_seen, and with `triangles` if there are any. The error gives the system's reason.
Status WriteMapCloud(const std::string& path,
                     const MapSnapshot& map,
                     const std::vector<std::array<int, 3>>& triangles = {});

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_MAP_PLY_H_
