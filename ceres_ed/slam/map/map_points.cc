#include "ceres_ed/slam/map/map_points.h"

#include <ceres_ed/slam/checkpoint.h>

namespace ceres_ed {

MapPoints::Record MapPoints::Pack(const MapPoint& point) {
  Record record;
  std::memcpy(record.position.data(), point.position.data(), sizeof(record.position));
  for (int i = 0; i < 3; ++i) {
    const double steps = std::round(kNormalSteps * std::clamp(point.normal[i], -1.0, 1.0));
    record.normal[i] = static_cast<std::int16_t>(steps);
    record.birth_position[i] = static_cast<float>(point.birth_position[i]);
    record.color[i] = point.color[i];
  }
  record.weight = static_cast<float>(point.weight);
  record.id = point.id;
  record.birth_frame = point.birth_frame;
  record.contradictions = static_cast<std::int16_t>(std::clamp(point.contradictions, 0, 32767));
  record.sightings = static_cast<std::uint8_t>(std::clamp(point.sightings, 0, 255));
  record.last_seen = point.last_seen;
  return record;
}

PointBinding MapPoints::Kept(const Binding& binding) {
  PointBinding kept(binding);
  double rest = 0.0;
  for (int i = 1; i < kept.size; ++i) {
    kept.weights[i] = static_cast<double>(static_cast<float>(kept.weights[i]));
    rest += kept.weights[i];
  }
  kept.weights[0] = 1.0 - rest;
  return kept;
}

void MapPoints::Bind(int slot, const Binding& binding) {
  CHECK(binding.size >= 1 && binding.size <= neighbors_) << "binding of " << binding.size;
  std::int32_t* row = bindings_[slot];
  std::fill_n(row, bindings_.width(), 0);
  for (int i = 0; i < neighbors_; ++i) row[i] = i < binding.size ? binding.nodes[i] : -1;
  for (int i = 1; i < binding.size; ++i) {
    const auto weight = static_cast<float>(binding.weights[i]);
    std::memcpy(&row[neighbors_ + i - 1], &weight, sizeof(weight));
  }
}

void MapPoints::Exchange(CheckpointArchive* archive) {
  archive->Rows("points", &records_);
  archive->Rows("bindings", &bindings_);
  if (bindings_.size() != records_.size()) bindings_.Resize(records_.size());
}

}  // namespace ceres_ed
