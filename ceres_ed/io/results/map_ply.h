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

// The points of a map at one time, metres; the vectors are of one length.
struct MapSnapshot {
  std::vector<Eigen::Vector3d> points;
  // Unit length.
  std::vector<Eigen::Vector3d> normals;
  // Red, green, blue.
  std::vector<std::array<std::uint8_t, 3>> colors;
  // Never reused.
  std::vector<int> ids;
  // The frame that saw the point first.
  std::vector<int> birth_frames;
  // Observations in the running average of the point.
  std::vector<double> weights;

  std::size_t size() const { return points.size(); }
};

// Writes the map, in the map frame, with the properties id, birth_frame and weight. Error: the
// system's reason.
Status WriteMapCloud(const std::string& path, const MapSnapshot& map);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_MAP_PLY_H_
