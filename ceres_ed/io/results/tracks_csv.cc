#include "ceres_ed/io/results/tracks_csv.h"

#include <ceres_ed/io/csv_table.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>

#include <cmath>
#include <cstddef>
#include <optional>

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

StatusOr<std::vector<TrackPlace>> ReadTracks(const std::string& path) {
  const StatusOr<std::vector<CsvRow>> rows = ReadCsvRows(path);
  if (!rows.ok()) return rows.status();
  std::vector<TrackPlace> places;
  for (const CsvRow& row : *rows) {
    constexpr std::size_t kFields = 6;
    Status status = row.ExpectFields(kFields);
    if (!status.ok()) return status;
    if (&row == &rows->front() && row.fields[0] == "frame") continue;
    const StatusOr<int> frame = ParseNatural(row.place, "frame", row.fields[0]);
    if (!frame.ok()) return frame.status();
    const StatusOr<int> id = ParseNatural(row.place, "id", row.fields[1]);
    if (!id.ok()) return id.status();
    TrackPlace place{*frame, *id};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::optional<double> value = ParseDouble(row.fields[2 + axis]);
      if (!value || !std::isfinite(*value)) {
        return Status::Error(row.place + "a coordinate is " + Quoted(row.fields[2 + axis]) +
                             ", expected a finite number of metres");
      }
      place.in_camera[static_cast<Eigen::Index>(axis)] = *value;
    }
    place.visible = row.fields[kFields - 1] == "1";
    places.push_back(place);
  }
  return places;
}

}  // namespace ceres_ed
