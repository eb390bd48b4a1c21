// The points of a map, packed: a map has twenty times as many of them as nodes.
#ifndef CERES_ED_SLAM_MAP_MAP_POINTS_H_
#define CERES_ED_SLAM_MAP_MAP_POINTS_H_

#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/util/chunked_rows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <Eigen/Core>
#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {

class CheckpointArchive;

// What the map knows of one point. Lengths are in map units. The map keeps `position` as it is;
// `weight` and `birth_position` to 24 bits, and of `normal` each component to 1 / 32767.
struct MapPoint {
  // Where it is while all nodes are at rest.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  // Unit length, at rest.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  // Number of observations in the running average.
  double weight = 0.0;
  std::array<std::uint8_t, 3> color = {200, 200, 200};
  // Never reused.
  int id = -1;
  int birth_frame = -1;
  // In the camera frame of that frame.
  Eigen::Vector3d birth_position = Eigen::Vector3d::Zero();
  // Frames in which the camera saw through it, less those in which it saw it; up to 32767.
  int contradictions = 0;
};

// A binding with its own memory.
struct PointBinding {
  PointBinding() = default;
  explicit PointBinding(const Binding& binding) : size(binding.size) {
    std::copy_n(binding.nodes, size, nodes);
    std::copy_n(binding.weights, size, weights);
  }

  // Valid as long as this is; what a call returns has to be kept first.
  // NOLINTNEXTLINE(google-explicit-constructor): it stands wherever a Binding does.
  operator Binding() const& { return {nodes, weights, size}; }
  operator Binding() const&& = delete;  // NOLINT(google-explicit-constructor)

  // Only the first `size` count.
  int nodes[kMaxBoundNodes];
  double weights[kMaxBoundNodes];
  int size = 0;
};

// Points and their bindings, each by slot; adding one moves none of the others. A point takes 60
// bytes and 8 for each of `neighbors` nodes, less 4: weights have 24 bits, and that of the first
// node is what the others leave of 1, so that they sum to 1 in double, far from the origin, too.
class MapPoints {
 public:
  // At most `neighbors` nodes a point, in [1, kMaxBoundNodes].
  explicit MapPoints(int neighbors)
      : neighbors_(neighbors), records_(1), bindings_(2 * neighbors - 1) {
    CHECK(neighbors >= 1 && neighbors <= kMaxBoundNodes) << "neighbors " << neighbors;
  }

  int neighbors() const { return neighbors_; }
  int size() const { return static_cast<int>(records_.size()); }
  // Of a slot without a point: -1.
  int id(int slot) const { return records_[slot]->id; }
  MapPoint operator[](int slot) const { return Unpack(*records_[slot]); }
  PointBinding binding(int slot) const {
    PointBinding binding;
    UnpackBinding(slot, &binding);
    return binding;
  }

  // Adds slots without points.
  void Resize(int slots) {
    records_.Resize(static_cast<std::size_t>(slots));
    bindings_.Resize(static_cast<std::size_t>(slots));
  }
  void Set(int slot, const MapPoint& point) { *records_[slot] = Pack(point); }
  // `binding` has 1 to neighbors() nodes, the strongest first.
  void Bind(int slot, const Binding& binding);
  void Remove(int slot) { records_[slot]->id = -1; }

  // Returns `binding` as it would be kept.
  static PointBinding Kept(const Binding& binding);

  std::size_t PointHeapBytes() const { return records_.HeapBytes(); }
  std::size_t BindingHeapBytes() const { return bindings_.HeapBytes(); }

  void Exchange(CheckpointArchive* archive);

 private:
  // Without gaps: checkpoints hold it as it lies in memory.
  struct Record {
    // Three doubles, which would ask for places that 60 bytes don't leave.
    std::array<std::uint32_t, 6> position = {};
    std::array<float, 3> birth_position = {};
    float weight = 0.0f;
    int id = -1;
    int birth_frame = -1;
    std::array<std::int16_t, 3> normal = {};
    std::int16_t contradictions = 0;
    std::array<std::uint8_t, 4> color = {};
  };
  static_assert(sizeof(Record) == 60, "a record has gaps");
  static constexpr double kNormalSteps = 32767.0;

  static Record Pack(const MapPoint& point);
  static MapPoint Unpack(const Record& record);
  void UnpackBinding(int slot, PointBinding* binding) const;

  int neighbors_;
  ChunkedRows<Record> records_;
  // Of each point its nodes, -1 behind the last, then the weights of all but the first as floats.
  ChunkedRows<std::int32_t> bindings_;
};

// Here, so that who looks at one member doesn't unpack the others.
inline MapPoint MapPoints::Unpack(const Record& record) {
  MapPoint point;
  std::memcpy(point.position.data(), record.position.data(), sizeof(record.position));
  for (int i = 0; i < 3; ++i) {
    point.normal[i] = record.normal[i] / kNormalSteps;
    point.birth_position[i] = static_cast<double>(record.birth_position[i]);
    point.color[i] = record.color[i];
  }
  point.weight = static_cast<double>(record.weight);
  point.id = record.id;
  point.birth_frame = record.birth_frame;
  point.contradictions = record.contradictions;
  return point;
}

inline void MapPoints::UnpackBinding(int slot, PointBinding* binding) const {
  const std::int32_t* row = bindings_[slot];
  double rest = 0.0;
  int size = 0;
  for (; size < neighbors_ && row[size] >= 0; ++size) {
    binding->nodes[size] = row[size];
    if (size == 0) continue;
    float weight;
    std::memcpy(&weight, &row[neighbors_ + size - 1], sizeof(weight));
    binding->weights[size] = static_cast<double>(weight);
    rest += binding->weights[size];
  }
  binding->weights[0] = 1.0 - rest;
  binding->size = size;
}

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_MAP_POINTS_H_
