#include "ceres_ed/io/sequence/picture_tracks.h"

#include <ceres_ed/io/csv_table.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>

#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace ceres_ed {

StatusOr<std::vector<TrackObservation>> ReadPictureTracks(const std::string& path) {
  const StatusOr<std::vector<CsvRow>> rows = ReadCsvRows(path);
  if (!rows.ok()) return rows.status();
  std::vector<TrackObservation> observations;
  std::set<std::pair<int, int>> seen;
  for (const CsvRow& row : *rows) {
    Status status = row.ExpectFields(4);
    if (!status.ok()) return status;
    const bool is_first = &row == &rows->front();
    if (is_first && row.fields == std::vector<std::string>{"frame", "track", "u", "v"}) continue;
    const StatusOr<int> frame = ParseNatural(row.place, "frame", row.fields[0]);
    if (!frame.ok()) return frame.status();
    const StatusOr<int> track = ParseNatural(row.place, "track", row.fields[1]);
    if (!track.ok()) return track.status();
    if (!seen.insert({*frame, *track}).second) {
      return Status::Error(row.place + "track " + row.fields[1] + " is there twice in frame " +
                           row.fields[0] + ", expected it once");
    }
    TrackObservation observation{*frame, *track};
    for (const int axis : {0, 1}) {
      const std::string& field = row.fields[2 + axis];
      const std::optional<double> value = ParseDouble(field);
      if (!value || !std::isfinite(*value)) {
        return Status::Error(row.place + (axis == 0 ? "u" : "v") + " is " + Quoted(field) +
                             ", expected a finite number of pixels");
      }
      observation.pixel[axis] = *value;
    }
    observations.push_back(observation);
  }
  return observations;
}

}  // namespace ceres_ed
