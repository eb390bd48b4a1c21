#include "ceres_ed/io/results/live_cloud_io.h"

#include <ceres_ed/io/atomic_file.h>

#include <cstdint>
#include <cstring>

namespace ceres_ed {
namespace {

constexpr std::size_t kRowSize = 32;

// Little endian on any machine; compilers make one store of it.
template <typename T>
void Put(T value, char** out) {
  static_assert(sizeof(T) == sizeof(std::uint32_t), "every property has four bytes");
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  for (int byte = 0; byte < 4; ++byte) *(*out)++ = static_cast<char>(bits >> (8 * byte));
}

}  // namespace

Status WriteLiveCloud(const std::string& path, const std::vector<LivePoint>& points) {
  std::string contents = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                         std::to_string(points.size()) +
                         "\nproperty float x\nproperty float y\nproperty float z\n"
                         "property int id\nproperty int birth_frame\n"
                         "property float bx\nproperty float by\nproperty float bz\nend_header\n";
  const std::size_t header_size = contents.size();
  contents.resize(header_size + kRowSize * points.size());
  char* out = contents.data() + header_size;
  for (const LivePoint& point : points) {
    for (int axis = 0; axis < 3; ++axis) Put(point.position[axis], &out);
    Put(point.id, &out);
    Put(point.birth_frame, &out);
    for (int axis = 0; axis < 3; ++axis) Put(point.birth_position[axis], &out);
  }
  return WriteFileAtomically(path, contents);
}

}  // namespace ceres_ed
