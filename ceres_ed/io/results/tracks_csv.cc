#include "ceres_ed/io/results/tracks_csv.h"

#include <ceres_ed/io/text_rows.h>

namespace ceres_ed {

std::string TracksHeader() { return "frame,id,x,y,z,visible\n"; }

std::string TracksRow(int frame, int id, const Eigen::Vector3d& in_camera, bool visible) {
  std::string row = std::to_string(frame) + "," + std::to_string(id);
  for (int axis = 0; axis < 3; ++axis) {
    std::string number;
    AppendNumbers({in_camera[axis]}, &number);
    row += "," + number;
  }
  return row + (visible ? ",1\n" : ",0\n");
}

}  // namespace ceres_ed
