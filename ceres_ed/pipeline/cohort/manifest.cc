#include "ceres_ed/pipeline/cohort/manifest.h"

#include <ceres_ed/io/csv_table.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/pipeline/fit/scale_setting.h>
#include <ceres_ed/util/nearest_word.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// A column of a table, and the member that it fills.
struct Column {
  const char* name;
  std::string CohortMember::*value;
  bool is_path;
};

// Returns the columns that a table may have. The first ones are required, as `num_required` says.
std::vector<Column> ColumnsOf(CohortKind kind, std::size_t* num_required) {
  using M = CohortMember;
  *num_required = kind == CohortKind::kPairs ? 2 : 1;
  std::vector<Column> columns;
  if (kind == CohortKind::kPairs) {
    columns = {{"source", &M::source, true},
               {"target", &M::path, true},
               {"source_landmarks", &M::source_landmarks, true},
               {"target_landmarks", &M::landmarks, true}};
  } else {
    columns = {{"path", &M::path, true}};
  }
  if (kind == CohortKind::kShapes) {
    columns.push_back({"landmarks", &M::landmarks, true});
    columns.push_back({"unit", &M::unit, false});
  }
  columns.push_back({"name", &M::name, false});
  columns.push_back({"group", &M::group, false});
  return columns;
}

bool HasMeshEnding(const fs::path& path) {
  return path.has_extension() && FindMeshFormat(path.string()) != nullptr;
}

// Returns a field without the quotes around it.
std::string Unquoted(const std::string& field) {
  const bool is_quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return is_quoted ? field.substr(1, field.size() - 2) : field;
}

// Returns the name of a file without its ending; of a folder, its name.
std::string StemOf(const std::string& path) {
  fs::path name = fs::path(path);
  if (!name.has_filename()) name = name.parent_path();
  return name.has_extension() && !fs::is_directory(path) ? name.stem().string()
                                                         : name.filename().string();
}

// Reads the header: for each field the column, or null.
StatusOr<std::vector<const Column*>> ReadHeader(const CsvRow& row,
                                                const std::vector<Column>& columns,
                                                std::size_t num_required,
                                                std::vector<std::string>* notes) {
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const Column& column : columns) names.emplace_back(column.name);
  std::vector<const Column*> found;
  for (const std::string& field : row.fields) {
    const std::string name = Unquoted(field);
    const auto at = std::find(names.begin(), names.end(), name);
    found.push_back(at == names.end() ? nullptr : &columns[at - names.begin()]);
    if (at != names.end()) {
      if (std::count(found.begin(), found.end(), found.back()) > 1) {
        return Status::Error(row.place + "the column " + Quoted(name) + " occurs twice");
      }
      continue;
    }
    const std::string meant = NearestWord(name, names);
    notes->push_back(row.place + "the column " + Quoted(name) + " is not used" +
                     (meant.empty() ? "" : "; is it " + Quoted(meant) + "?"));
  }
  for (std::size_t c = 0; c < num_required; ++c) {
    if (std::find(found.begin(), found.end(), &columns[c]) != found.end()) continue;
    return Status::Error(row.place + "no column " + Quoted(names[c]) +
                         ", expected a header such as " +
                         (num_required == 2 ? "name,source,target" : "name,path,group"));
  }
  return found;
}

Status CheckUnit(const std::string& place, const std::string& unit) {
  if (unit.empty()) return Status::Ok();
  if (ParseScale(unit + ":mm").ok()) return Status::Ok();
  return Status::Error(place + "the unit is " + Quoted(unit) + ", expected um, mm, cm, in or m");
}

Status ReadTable(const std::string& path, Manifest* manifest) {
  std::size_t num_required = 0;
  const std::vector<Column> columns = ColumnsOf(manifest->kind, &num_required);
  const StatusOr<std::vector<CsvRow>> rows = ReadCsvRows(path);
  if (!rows.ok()) return rows.status();
  if (rows->empty()) return Status::Error(path + ": is empty, expected a header and rows");
  const auto header = ReadHeader(rows->front(), columns, num_required, &manifest->notes);
  if (!header.ok()) return header.status();
  const fs::path folder = fs::path(path).parent_path();
  for (std::size_t r = 1; r < rows->size(); ++r) {
    const CsvRow& row = (*rows)[r];
    if (Status status = row.ExpectFields(header->size()); !status.ok()) return status;
    CohortMember member;
    member.row = static_cast<int>(r) - 1;
    for (std::size_t f = 0; f < row.fields.size(); ++f) {
      const Column* const column = (*header)[f];
      if (column == nullptr) continue;
      const std::string field = Unquoted(row.fields[f]);
      const bool is_seen_from_table = column->is_path && !field.empty();
      member.*column->value = is_seen_from_table ? (folder / field).string() : field;
    }
    for (std::size_t c = 0; c < num_required; ++c) {
      if (!(member.*columns[c].value).empty()) continue;
      return Status::Error(row.place + "no " + columns[c].name + ", expected the path of a file");
    }
    if (member.name.empty()) {
      member.name = StemOf(member.path);
      if (!member.source.empty()) member.name = StemOf(member.source) + "_" + member.name;
    }
    if (Status status = CheckUnit(row.place, member.unit); !status.ok()) return status;
    if (Status status = CheckMemberName(member.name); !status.ok()) {
      return Status::Error(row.place + status.message());
    }
    manifest->members.push_back(std::move(member));
  }
  return Status::Ok();
}

// Returns the file of landmarks beside a shape; empty if there is none.
std::string LandmarksBeside(const fs::path& shape) {
  for (const char* const ending : {".mrk.json", ".fcsv", ".landmarks.csv", ".pts"}) {
    fs::path file = shape;
    file.replace_extension(ending);
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored)) return file.string();
  }
  return "";
}

Status ReadFolder(const std::string& path, bool with_landmarks, Manifest* manifest) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (auto entry = fs::directory_iterator(path, error); !error && entry != fs::end(entry);
       entry.increment(error)) {
    if (entry->path().filename().string()[0] != '.') entries.push_back(entry->path());
  }
  if (error) return Status::Error(path + ": cannot read: " + error.message());
  std::sort(entries.begin(), entries.end());
  for (const fs::path& entry : entries) {
    const bool is_member = manifest->kind == CohortKind::kSequences
                               ? fs::is_directory(entry, error)
                               : fs::is_regular_file(entry, error) && HasMeshEnding(entry);
    if (!is_member) continue;
    CohortMember member;
    member.row = static_cast<int>(manifest->members.size());
    member.path = entry.string();
    member.name = StemOf(member.path);
    if (with_landmarks) member.landmarks = LandmarksBeside(entry);
    if (Status status = CheckMemberName(member.name); !status.ok()) {
      return Status::Error(member.path + ": " + status.message());
    }
    manifest->members.push_back(std::move(member));
  }
  return Status::Ok();
}

}  // namespace

Status CheckMemberName(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("._-+ ").find(c) != std::string_view::npos;
  };
  const bool is_good = !name.empty() && name.size() <= kLongest && name[0] != '.' &&
                       std::all_of(name.begin(), name.end(), is_allowed);
  if (is_good) return Status::Ok();
  return Status::Error("the name is " + Quoted(name) +
                       ", expected 1 to 200 letters, digits and any of ._-+ and blanks, not "
                       "beginning with a dot");
}

StatusOr<Manifest> ReadManifest(const std::string& path, CohortKind kind, bool with_landmarks) {
  Manifest manifest;
  manifest.kind = kind;
  std::error_code ignored;
  const bool is_folder = kind != CohortKind::kPairs && fs::is_directory(path, ignored);
  Status status =
      is_folder ? ReadFolder(path, with_landmarks, &manifest) : ReadTable(path, &manifest);
  if (!status.ok()) return status;
  if (manifest.members.empty()) {
    return Status::Error(path + ": has no " + NameOf(kind) + ", expected at least one");
  }
  std::map<std::string, int> rows;
  for (const CohortMember& member : manifest.members) {
    const auto [first, is_new] = rows.emplace(member.name, member.row);
    if (is_new) continue;
    return Status::Error(path + ": the name " + Quoted(member.name) + " stands in row " +
                         std::to_string(first->second + 1) + " and in row " +
                         std::to_string(member.row + 1) + ", expected different names");
  }
  return manifest;
}

std::string MemberCount(int count) {
  return std::to_string(count) + (count == 1 ? " member" : " members");
}

StatusOr<Shard> ParseShard(const std::string& text) {
  Shard shard;
  if (text.empty()) return shard;
  const std::size_t slash = text.find('/');
  const auto parse = [](std::string_view word, int* number) {
    const auto result = std::from_chars(word.data(), word.data() + word.size(), *number);
    return result.ec == std::errc() && result.ptr == word.data() + word.size();
  };
  const std::string_view view = text;
  const bool is_good = slash != std::string::npos && parse(view.substr(0, slash), &shard.index) &&
                       parse(view.substr(slash + 1), &shard.count) && shard.index >= 1 &&
                       shard.index <= shard.count;
  if (is_good) return shard;
  return Status::Error("--shard=" + text + ", expected i/n with 1 <= i <= n, such as 2/8");
}

}  // namespace ceres_ed
