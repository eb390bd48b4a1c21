// The tables that list the members of a cohort.
#ifndef CERES_ED_PIPELINE_COHORT_MANIFEST_H_
#define CERES_ED_PIPELINE_COHORT_MANIFEST_H_

#include <ceres_ed/pipeline/cohort/cohort_settings.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// What the members of a cohort are.
enum class CohortKind { kShapes, kPairs, kSequences };

constexpr std::array<NamedValue<CohortKind>, 3> NamesOf(CohortKind) {
  return {{{"shapes", CohortKind::kShapes},
           {"pairs", CohortKind::kPairs},
           {"sequences", CohortKind::kSequences}}};
}

// A shape, a pair or a sequence. Paths are seen from the current folder; what is not given is
// empty.
struct CohortMember {
  // Unique; it is the name of a folder, too.
  std::string name;
  // Its number among all, from 0 on.
  int row = 0;
  // The file of the shape (of a pair: the target), or the folder of the sequence.
  std::string path;
  // Named landmarks on the shape.
  std::string landmarks;
  // The source of a pair, and named landmarks on it.
  std::string source;
  std::string source_landmarks;
  // The unit of the file; empty if it is that of the template.
  std::string unit;
  // The group to which it belongs.
  std::string group;
};

struct Manifest {
  CohortKind kind = CohortKind::kShapes;
  // In the order of the table.
  std::vector<CohortMember> members;
  // Columns that are not used, and the like, in sentences.
  std::vector<std::string> notes;
};

// Reads the members:
//   - a table (CSV) with a header that names its columns: `path`, and `name`, `landmarks`, `unit`,
//     `group` as far as they are given; for pairs `source` and `target` in the place of `path`, and
//     `source_landmarks`, `target_landmarks`. Paths are seen from the folder of the table. A member
//     without a name has that of its file, without the ending;
//   - a folder of shapes: every file of it with the ending of a mesh, sorted by name, but for
//     hidden ones. A file of landmarks with the same name (NAME.mrk.json, NAME.fcsv,
//     NAME.landmarks.csv, NAME.pts) belongs to the shape if `with_landmarks`;
//   - a folder of folders, for sequences.
// Errors name the file, the line, the value and what was expected: a column is missing, a row has
// another number of fields than the header, a name cannot be that of a folder or occurs twice, a
// unit is unknown, or there are no members. Files of members need not exist.
StatusOr<Manifest> ReadManifest(const std::string& path, CohortKind kind, bool with_landmarks);

// Returns "1 member", "12 members".
std::string MemberCount(int count);

// Returns the shard that `text` ("2/8") names; the whole if it is empty. The error says what was
// expected.
StatusOr<Shard> ParseShard(const std::string& text);

// Returns an error unless `name` can be the name of a folder everywhere: 1 to 200 letters, digits
// and any of "._-+ ", not beginning with a dot.
Status CheckMemberName(const std::string& name);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_MANIFEST_H_
