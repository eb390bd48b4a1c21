// The points of a map in a compact form: a map has twenty times as many points as nodes.
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

// One point of the map. Lengths are in map units. The map stores `position` exactly, `weight` and
// `birth_position` with 24 bits, and each component of `normal` to 1 / 32767.
struct MapPoint {
  // The position of the point when all nodes are at rest.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  // The normal at rest, of unit length.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  // The number of observations in the running average.
  double weight = 0.0;
  std::array<std::uint8_t, 3> color = {200, 200, 200};
  // The identifier, which is never used again.
  int id = -1;
  int birth_frame = -1;
  // The position in the camera frame of the frame `birth_frame`.
  Eigen::Vector3d birth_position = Eigen::Vector3d::Zero();
  // The number of frames in which the camera saw through the point, minus those in which it saw the
  // point; at most 32767.
  int contradictions = 0;
  // The number of frames in which the point lay on the observed surface, at most 255, and the last
  // one of these; the frame of its birth is one of them.
  int sightings = 1;
  int last_seen = -1;

  // Returns whether the point has been seen in too few frames to be certain.
  bool IsTentative() const { return sightings < kStableSightings; }
  // Returns whether so many frames contradict the point that it has to go.
  bool IsRefuted() const {
    return contradictions >= (IsTentative() ? kMaxTentativeContradictions : kMaxContradictions);
  }
  // Returns how certain the point is, in [0, 1]: 1 after enough sightings without contradiction.
  double Stability() const {
    return std::min(1.0, static_cast<double>(sightings) / kStableSightings) *
           std::max(0.0, 1.0 - static_cast<double>(contradictions) / kMaxContradictions);
  }

  // Errors of the depth stay where the camera was, and are not seen again at one place of the
  // tissue.
  static constexpr int kStableSightings = 4;
  static constexpr int kMaxContradictions = 5;
  static constexpr int kMaxTentativeContradictions = 2;
};

// A binding that owns its memory.
struct PointBinding {
  PointBinding() = default;
  explicit PointBinding(const Binding& binding) : size(binding.size) {
    std::copy_n(binding.nodes, size, nodes);
    std::copy_n(binding.weights, size, weights);
  }

  // The result is valid as long as this object exists; a temporary object must be stored first.
  // NOLINTNEXTLINE(google-explicit-constructor): it stands wherever a Binding does.
  operator Binding() const& { return {nodes, weights, size}; }
  operator Binding() const&& = delete;  // NOLINT(google-explicit-constructor)

  // Only the first `size` entries are used.
  int nodes[kMaxBoundNodes];
  double weights[kMaxBoundNodes];
  int size = 0;
};

// Points and their bindings, by slot. Adding a point does not move others in memory. With n =
// `neighbors`, a point takes 64 + 8 n - 4 bytes: weights have 24 bits, and the weight of the first
// node is 1 minus the others, so that the weights sum to 1 in double precision, which matters far
// from the origin.
class MapPoints {
 public:
  // A point is bound to at most `neighbors` nodes, in [1, kMaxBoundNodes].
  explicit MapPoints(int neighbors)
      : neighbors_(neighbors), records_(1), bindings_(2 * neighbors - 1) {
    CHECK(neighbors >= 1 && neighbors <= kMaxBoundNodes) << "neighbors " << neighbors;
  }

  int neighbors() const { return neighbors_; }
  int size() const { return static_cast<int>(records_.size()); }
  // Returns the identifier of the point in a slot, or -1 if the slot is empty.
  int id(int slot) const { return records_[slot]->id; }
  MapPoint operator[](int slot) const { return Unpack(*records_[slot]); }
  PointBinding binding(int slot) const {
    PointBinding binding;
    UnpackBinding(slot, &binding);
    return binding;
  }

  // Adds empty slots, so that there are `slots` in all.
  void Resize(int slots) {
    records_.Resize(static_cast<std::size_t>(slots));
    bindings_.Resize(static_cast<std::size_t>(slots));
  }
  // Stores a point in a slot.
  void Set(int slot, const MapPoint& point) { *records_[slot] = Pack(point); }
  // Stores the binding of a slot. `binding` has 1 to neighbors() nodes, the strongest first.
  void Bind(int slot, const Binding& binding);
  // Empties a slot.
  void Remove(int slot) { records_[slot]->id = -1; }

  // Returns `binding` as it is stored, with rounded weights.
  static PointBinding Kept(const Binding& binding);

  std::size_t PointHeapBytes() const { return records_.HeapBytes(); }
  std::size_t BindingHeapBytes() const { return bindings_.HeapBytes(); }

  // Saves all points, or loads them and replaces the present ones.
  void Exchange(CheckpointArchive* archive);

 private:
  // A record has no padding, because checkpoints store it as it lies in memory.
  struct Record {
    std::array<double, 3> position = {};
    std::array<float, 3> birth_position = {};
    float weight = 0.0f;
    int id = -1;
    int birth_frame = -1;
    int last_seen = -1;
    std::array<std::int16_t, 3> normal = {};
    std::int16_t contradictions = 0;
    std::array<std::uint8_t, 3> color = {};
    std::uint8_t sightings = 0;
  };
  static_assert(sizeof(Record) == 64, "a record has gaps");
  static constexpr double kNormalSteps = 32767.0;

  static Record Pack(const MapPoint& point);
  static MapPoint Unpack(const Record& record);
  void UnpackBinding(int slot, PointBinding* binding) const;

  int neighbors_;
  ChunkedRows<Record> records_;
  // For each point its nodes, followed by -1 for unused places, then all weights except the first
  // as floats.
  ChunkedRows<std::int32_t> bindings_;
};

// Inline, so that code that reads one member does not unpack the others.
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
  point.sightings = record.sightings;
  point.last_seen = record.last_seen;
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
