#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/mesh/off_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

class OffReader {
 public:
  explicit OffReader(const std::string& path) : path_(path) {}

  StatusOr<PlyDocument> Read() {
    const Status status = ForEachTextRow(path_, [this](const TextRow& row) {
      place_ = row.place;
      if (!has_keyword_) {
        has_keyword_ = true;
        // The counts may follow in the same line, and the keyword may be missing.
        const bool is_keyword = !ParseDouble(row.fields[0]).has_value();
        if (is_keyword) {
          if (Status read = ReadKeyword(row.fields[0]); !read.ok()) return read;
        }
        if (is_keyword && row.fields.size() == 1) return Status::Ok();
        TextRow rest = row;
        if (is_keyword) rest.fields.erase(rest.fields.begin());
        return ReadCounts(rest);
      }
      if (!has_counts_) return ReadCounts(row);
      if (vertex_rows_ < num_vertices_) return ReadVertex(row);
      if (sizes_.size() < num_faces_) return ReadFace(row);
      ++more_lines_;
      return Status::Ok();
    });
    if (!status.ok()) return status;
    if (!has_counts_) return Status::Error(path_ + ": no counts of vertices and faces");
    if (vertex_rows_ < num_vertices_ || sizes_.size() < num_faces_) return Truncated();
    return Assemble();
  }

 private:
  Status ReadKeyword(std::string_view word) {
    const std::size_t off = word.rfind("OFF");
    bool is_known = off != std::string_view::npos && off + 3 == word.size();
    for (std::size_t i = 0; is_known && i < off; ++i) {
      if (word[i] == 'C') {
        has_colors_ = true;
      } else if (word[i] == 'N') {
        has_normals_ = true;
      } else if (word[i] == 'S' && word[i + 1] == 'T') {
        has_textures_ = true;
        ++i;
      } else {
        is_known = false;
      }
    }
    if (is_known) return Status::Ok();
    return Error("the keyword is " + Quoted(word) +
                 ", expected OFF, with C, N or ST ahead of it (in three dimensions, ascii)");
  }

  Status ReadCounts(const TextRow& row) {
    if (row.fields.size() < 2 || row.fields.size() > 3) {
      return Error("the row has " + Counted(row.fields.size(), "field") +
                   ", expected the counts of vertices, faces and edges");
    }
    const StatusOr<int> vertices = ParseNatural(place_, "the count of vertices", row.fields[0]);
    if (!vertices.ok()) return vertices.status();
    const StatusOr<int> faces = ParseNatural(place_, "the count of faces", row.fields[1]);
    if (!faces.ok()) return faces.status();
    num_vertices_ = static_cast<std::size_t>(*vertices);
    num_faces_ = static_cast<std::size_t>(*faces);
    has_counts_ = true;
    return Status::Ok();
  }

  Status ReadVertex(const TextRow& row) {
    const std::size_t size = row.fields.size();
    if (vertex_rows_ == 0) {
      const std::size_t known = 3U + (has_normals_ ? 3U : 0U) + (has_textures_ ? 2U : 0U);
      // Some programs write colours without a C.
      const std::size_t more = size > known ? size - known : 0;
      if (has_colors_ || more == 3 || more == 4) num_channels_ = more;
      num_columns_ = known + num_channels_;
      if (has_colors_ && num_channels_ != 3 && num_channels_ != 4) num_columns_ = 0;
    }
    if (num_columns_ == 0 || size != num_columns_) {
      return Error("a vertex of " + Counted(size, "number") + ", expected " +
                   (num_columns_ == 0 ? "coordinates and red green blue, or alpha too"
                                      : std::to_string(num_columns_) + " as the keyword says"));
    }
    ++vertex_rows_;
    return Append(row, 0, &values_);
  }

  Status ReadFace(const TextRow& row) {
    const StatusOr<int> size = ParseNatural(place_, "the number of corners", row.fields[0]);
    if (!size.ok()) return size.status();
    const auto corners = static_cast<std::size_t>(*size);
    if (row.fields.size() < corners + 1) {
      return Error("a face of " + Counted(corners, "corner") + " names " +
                   std::to_string(row.fields.size() - 1));
    }
    for (std::size_t i = 1; i <= corners; ++i) {
      const StatusOr<int> vertex = ParseNatural(place_, "a corner", row.fields[i]);
      if (!vertex.ok()) return vertex.status();
      if (static_cast<std::size_t>(*vertex) >= num_vertices_) {
        return Error("a face names vertex " + std::to_string(*vertex) + ", the file has " +
                     std::to_string(num_vertices_));
      }
      corners_.push_back(*vertex);
    }
    sizes_.push_back(static_cast<std::uint32_t>(corners));
    // One number is an index into a table of colours.
    const std::size_t more = row.fields.size() - 1 - corners;
    if (more != 3 && more != 4) {
      other_colors_ += more == 0 ? 0 : 1;
      return Status::Ok();
    }
    if (face_colors_.empty()) face_channels_ = more;
    if (more < face_channels_) {
      ++other_colors_;
      return Status::Ok();
    }
    const std::size_t begin = face_colors_.size();
    if (Status status = Append(row, corners + 1, &face_colors_); !status.ok()) return status;
    face_colors_.resize(begin + face_channels_);
    return Status::Ok();
  }

  Status Append(const TextRow& row, std::size_t first, std::vector<double>* values) {
    for (std::size_t i = first; i < row.fields.size(); ++i) {
      const std::optional<double> value = ParseDouble(row.fields[i]);
      if (!value.has_value()) return Error(Quoted(row.fields[i]) + " is no number");
      values->push_back(*value);
    }
    return Status::Ok();
  }

  PlyDocument Assemble() {
    PlyDocument document;
    PlyElement vertices;
    vertices.name = "vertex";
    vertices.count = num_vertices_;
    std::size_t first = 0;
    for (const char* const name : {"x", "y", "z"}) AddColumn(name, first++, &vertices);
    if (has_normals_) {
      for (const char* const name : {"nx", "ny", "nz"}) AddColumn(name, first++, &vertices);
    }
    if (num_channels_ > 0 && num_vertices_ > 0) {
      std::vector<double> colors;
      for (std::size_t row = 0; row < num_vertices_; ++row) {
        const double* const begin = values_.data() + row * num_columns_ + first;
        colors.insert(colors.end(), begin, begin + num_channels_);
      }
      AddColors(std::move(colors), num_channels_, &vertices);
      first += num_channels_;
    }
    if (has_textures_) {
      for (const char* const name : {"s", "t"}) AddColumn(name, first++, &vertices);
    }
    document.elements.push_back(std::move(vertices));
    if (!sizes_.empty()) {
      const bool all_colored = face_colors_.size() == face_channels_ * num_faces_;
      AppendFaces(std::move(corners_), std::move(sizes_), &document);
      if (!face_colors_.empty() && all_colored) {
        AddColors(std::move(face_colors_), face_channels_, &document.elements.back());
      } else if (!face_colors_.empty() || other_colors_ > 0) {
        document.warnings.emplace_back(
            "the colours of faces are left out: some have none, or a number in a table");
      }
    }
    if (more_lines_ > 0) {
      document.warnings.push_back(Counted(more_lines_, "line") + " behind the last face left out");
    }
    return document;
  }

  void AddColumn(const char* name, std::size_t column, PlyElement* element) const {
    PlyProperty property = MakePlyScalar(name, PlyType::kFloat64);
    property.values.reserve(num_vertices_);
    for (std::size_t row = 0; row < num_vertices_; ++row) {
      property.values.push_back(values_[row * num_columns_ + column]);
    }
    element->properties.push_back(std::move(property));
  }

  static void AddColors(std::vector<double> colors, std::size_t channels, PlyElement* element) {
    const bool are_bytes =
        std::any_of(colors.begin(), colors.end(), [](double value) { return value > 1.0; });
    // What is beyond the range of its kind, or no number, is written within it.
    for (double& value : colors) {
      const double share = are_bytes ? value / 255.0 : value;
      value = share > 0.0 ? std::min(share, 1.0) : 0.0;
    }
    AppendColors(colors, channels, element);
  }

  Status Truncated() const {
    return Status::Error(path_ + ": truncated: " + std::to_string(vertex_rows_) + " of " +
                         Counted(num_vertices_, "vertex") + " and " +
                         std::to_string(sizes_.size()) + " of " + Counted(num_faces_, "face"));
  }
  Status Error(const std::string& what) const { return Status::Error(place_ + what); }

  const std::string& path_;
  std::string place_;
  bool has_keyword_ = false;
  bool has_counts_ = false;
  bool has_colors_ = false;
  bool has_normals_ = false;
  bool has_textures_ = false;
  std::size_t num_vertices_ = 0;
  std::size_t num_faces_ = 0;
  std::size_t vertex_rows_ = 0;
  std::size_t num_channels_ = 0;
  std::size_t num_columns_ = 0;
  std::vector<double> values_;
  std::vector<double> corners_;
  std::vector<std::uint32_t> sizes_;
  std::size_t face_channels_ = 0;
  std::vector<double> face_colors_;
  std::size_t other_colors_ = 0;
  std::size_t more_lines_ = 0;
};

}  // namespace

StatusOr<PlyDocument> ReadOff(const std::string& path) { return OffReader(path).Read(); }

}  // namespace ceres_ed
