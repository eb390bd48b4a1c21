// Landmarks in lines of text: .fcsv, .pts and .csv.
#include <ceres_ed/io/landmarks/landmark_parsers.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

namespace ceres_ed {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// The columns of a row that are read; kNone if there is no name.
struct Columns {
  std::size_t name = kNone;
  std::array<std::size_t, 3> position = {kNone, kNone, kNone};
};

// Fields point into the text of the file.
using Fields = std::vector<std::string_view>;

// Cuts at commas outside of quotes, and removes the blanks around a field.
Fields SplitCsv(std::string_view line) {
  Fields fields;
  std::size_t begin = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') is_quoted = !is_quoted;
    if (i < line.size() && (line[i] != ',' || is_quoted)) continue;
    fields.push_back(Trim(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  return fields;
}

// Returns a field without its quotes; two of them in a row stand for one.
std::string Unquoted(std::string_view field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"' && field[i + 1] == '"') ++i;
  }
  return text;
}

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

bool IsNumber(std::string_view field) { return ParseDouble(field).has_value(); }

class LineParser {
 public:
  LineParser(const std::string& path, LandmarkFile* file) : path_(path), file_(file) {}

  // Calls `read` for each line that is not blank, a comment included.
  Status ForEachLine(const std::function<Status(std::string_view)>& read) {
    std::string_view rest = file_->text;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (rest.substr(0, 3) == kByteOrderMark) rest.remove_prefix(3);
    for (const std::string_view line : SplitLines(rest, '\n')) {
      ++line_;
      const std::string_view text = Trim(line);
      if (text.empty()) continue;
      if (Status status = read(text); !status.ok()) return status;
    }
    return Status::Ok();
  }

  Status AddPoint(const Fields& fields, const Columns& columns) {
    NamedLandmark point;
    std::array<LandmarkFile::Place, 3> places;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t column = columns.position[axis];
      if (column >= fields.size()) {
        return Error(std::to_string(fields.size()) + " fields, expected a name and x y z");
      }
      const std::optional<double> value = ParseDouble(fields[column]);
      if (!value.has_value() || !std::isfinite(*value)) {
        return Error("a coordinate is " + Quoted(fields[column]) + ", expected a finite number");
      }
      point.position[static_cast<Eigen::Index>(axis)] = *value;
      places[axis] = {static_cast<std::size_t>(fields[column].data() - file_->text.data()),
                      fields[column].size()};
    }
    if (columns.name < fields.size()) point.name = Unquoted(fields[columns.name]);
    file_->points.push_back(std::move(point));
    file_->places.push_back(places);
    return Status::Ok();
  }

  Status Error(const std::string& what) const {
    return Status::Error(path_ + ": line " + std::to_string(line_) + ": " + what);
  }

  const std::string& path() const { return path_; }
  LandmarkFile& file() { return *file_; }

 private:
  const std::string& path_;
  LandmarkFile* file_;
  int line_ = 0;
};

// Finds the columns of a header of names in lower case; nothing if it names no coordinates.
std::optional<Columns> ColumnsOf(const std::vector<std::string>& header,
                                 LandmarkSide side,
                                 AnatomicalSpace* space) {
  const auto find = [&header](const std::string& name) {
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? kNone : static_cast<std::size_t>(found - header.begin());
  };
  Columns columns;
  for (const char* const name : {"label", "name", "id", "landmark"}) {
    if (columns.name == kNone) columns.name = find(name);
  }
  const std::string prefix = side == LandmarkSide::kSource ? "source_" : "target_";
  const std::array<std::array<std::string, 3>, 4> names = {
      {{prefix + "x", prefix + "y", prefix + "z"},
       {"x", "y", "z"},
       {"l", "p", "s"},
       {"r", "a", "s"}}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) columns.position[axis] = find(names[i][axis]);
    const bool has_all = std::none_of(columns.position.begin(),
                                      columns.position.end(),
                                      [](std::size_t column) { return column == kNone; });
    if (!has_all) continue;
    if (i == 2) *space = AnatomicalSpace::kLps;
    if (i == 3) *space = AnatomicalSpace::kRas;
    return columns;
  }
  return std::nullopt;
}

std::vector<std::string> HeaderOf(const Fields& fields) {
  std::vector<std::string> header;
  for (const std::string_view field : fields) header.push_back(Lower(Unquoted(field)));
  return header;
}

// Returns the text behind `= ` of a comment `# key = value`, or nothing.
std::optional<std::string_view> ValueOf(std::string_view comment, std::string_view key) {
  const std::size_t equals = comment.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const std::string_view name = Trim(comment.substr(1, equals - 1));
  if (name != key) return std::nullopt;
  return Trim(comment.substr(equals + 1));
}

}  // namespace

Status ParseFcsv(const std::string& path, LandmarkFile* file) {
  LineParser parser(path, file);
  // Those of Slicer 4 and 5; a comment may name others.
  Columns columns;
  columns.name = 11;
  columns.position = {1, 2, 3};
  Status status = parser.ForEachLine([&](std::string_view line) {
    if (line.front() != '#') return parser.AddPoint(SplitCsv(line), columns);
    if (const auto names = ValueOf(line, "columns"); names.has_value()) {
      AnatomicalSpace ignored = AnatomicalSpace::kUnknown;
      const auto found = ColumnsOf(HeaderOf(SplitCsv(*names)), LandmarkSide::kSource, &ignored);
      if (found.has_value()) columns = *found;
    }
    if (const auto space = ValueOf(line, "CoordinateSystem"); space.has_value()) {
      if (*space == "LPS" || *space == "1") {
        file->space = AnatomicalSpace::kLps;
      } else if (*space == "RAS" || *space == "0") {
        file->space = AnatomicalSpace::kRas;
      } else {
        return parser.Error("CoordinateSystem is " + Quoted(*space) + ", expected LPS or RAS");
      }
    }
    return Status::Ok();
  });
  if (status.ok() && file->space == AnatomicalSpace::kUnknown) {
    file->space = AnatomicalSpace::kRas;
    file->warnings.push_back(path +
                             ": no CoordinateSystem, so it is taken as RAS, as that of old "
                             "files of 3D Slicer");
  }
  return status;
}

Status ParsePts(const std::string& path, LandmarkFile* file) {
  LineParser parser(path, file);
  return parser.ForEachLine([&](std::string_view line) {
    const std::string_view text = Trim(line.substr(0, line.find('#')));
    const Fields fields = SplitWords(text, ", \t\r");
    if (fields.empty()) return Status::Ok();
    const bool is_start = file->points.empty();
    const std::string word = Lower(fields[0]);
    const bool is_head = word == "version" || word == "version:" || word == "n_points:" ||
                         word == "{" || word == "}" || (fields.size() == 1 && IsNumber(fields[0]));
    if (is_head && (is_start || word == "}")) return Status::Ok();
    Columns columns;
    if (fields.size() == 3) {
      columns.position = {0, 1, 2};
    } else if (fields.size() == 4) {
      columns.name = 0;
      columns.position = {1, 2, 3};
    } else {
      return parser.Error(std::to_string(fields.size()) +
                          (fields.size() == 1 ? " field" : " fields") +
                          ", expected x y z, or a name and x y z");
    }
    return parser.AddPoint(fields, columns);
  });
}

Status ParseLandmarkCsv(const std::string& path, LandmarkSide side, LandmarkFile* file) {
  LineParser parser(path, file);
  std::optional<Columns> columns;
  bool is_first = true;
  return parser.ForEachLine([&](std::string_view line) {
    if (line.front() == '#') {
      // The names of the columns may stand in a comment, behind a sentence that ends in ';'.
      const std::size_t sentence = line.rfind(';');
      const std::string_view names =
          line.substr(sentence == std::string_view::npos ? 1 : sentence + 1);
      if (is_first) columns = ColumnsOf(HeaderOf(SplitCsv(names)), side, &file->space);
      return Status::Ok();
    }
    const Fields fields = SplitCsv(line);
    if (std::exchange(is_first, false)) {
      const bool is_row = std::any_of(fields.begin(), fields.end(), IsNumber);
      if (!is_row) {
        columns = ColumnsOf(HeaderOf(fields), side, &file->space);
        if (columns.has_value()) return Status::Ok();
        return parser.Error("the header is " + Quoted(line) +
                            ", expected the columns label and x, y, z among others");
      }
    }
    if (!columns.has_value()) {
      columns.emplace();
      // Rows of numbers alone have no names.
      const bool is_bare = fields.size() == 3;
      columns->name = is_bare ? kNone : 0;
      columns->position = {is_bare ? 0U : 1U, is_bare ? 1U : 2U, is_bare ? 2U : 3U};
    }
    return parser.AddPoint(fields, *columns);
  });
}

}  // namespace ceres_ed
