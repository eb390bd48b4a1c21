// This reader and that of OFF are our own, because no library of Debian 12 keeps the vertices of
// these formats: assimp splits them at corners and keeps floats, VTK's readers keep floats, and the
// number parser of tinyobjloader is wrong in the last digits (README.md).
#include <ceres_ed/io/mesh/face_groups.h>
#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/mesh/obj_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

constexpr int kNone = -1;

using Words = std::vector<std::string_view>;

// Vertex, texture vertex and normal of a corner; kNone for one that is not given.
using Corner = std::array<int, 3>;

class ObjReader {
 public:
  explicit ObjReader(const std::string& path) : path_(path) {}

  StatusOr<PlyDocument> Read() {
    Status status = ForEachTextLine(path_, [this](std::string_view line, int number) {
      // A backslash at the end continues a line.
      if (line.back() == '\\') {
        continued_.append(line.substr(0, line.size() - 1));
        continued_ += ' ';
        return Status::Ok();
      }
      line_ = number;
      if (continued_.empty()) return ReadLine(line);
      const std::string whole = continued_ + std::string(line);
      continued_.clear();
      return ReadLine(whole);
    });
    if (status.ok()) status = CheckCorners();
    if (!status.ok()) return status;
    AddVertices();
    AddFaces();
    AddEdges();
    AddWarnings();
    return std::move(document_);
  }

 private:
  Status ReadLine(std::string_view line) {
    words_ = SplitWords(line, " \t\r");
    if (words_.empty()) return Status::Ok();
    const std::string_view keyword = words_[0];
    if (keyword == "v") return ReadVertex();
    if (keyword == "f") return ReadFace();
    if (keyword == "vn") return ReadVector(3, 3, &normals_);
    if (keyword == "vt") return ReadVector(1, 3, &textures_);
    if (keyword == "l") return ReadPolyline();
    const std::string_view rest = Trim(line.substr(line.find(keyword) + keyword.size()));
    if (keyword == "mtllib") {
      document_.comments.push_back("mtllib " + std::string(rest));
      return Status::Ok();
    }
    for (std::size_t i = 0; i < FaceGroup::kKeywords.size(); ++i) {
      if (keyword != FaceGroup::kKeywords[i]) continue;
      group_.names[i] = std::string(rest);
      return Status::Ok();
    }
    ++skipped_[std::string(keyword)];
    return Status::Ok();
  }

  Status ReadVertex() {
    const std::size_t size = words_.size() - 1;
    if (size < 3 || size == 5 || size > 8) {
      return Error("a vertex of " + Counted(size, "number") +
                   ", expected x y z, which w or r g b may follow");
    }
    std::array<double, 8> numbers = {};
    for (std::size_t i = 0; i < size; ++i) {
      if (Status status = ReadNumber(words_[i + 1], &numbers[i]); !status.ok()) return status;
    }
    vertices_.push_back({numbers[0], numbers[1], numbers[2]});
    if (size == 4 || size == 8) ++weights_;
    if (size >= 6) colors_.insert(colors_.end(), numbers.begin() + 3, numbers.begin() + 6);
    return Status::Ok();
  }

  Status ReadVector(std::size_t least,
                    std::size_t most,
                    std::vector<std::array<double, 3>>* vectors) {
    const std::size_t size = words_.size() - 1;
    if (size < least || size > most) {
      return Error("'" + std::string(words_[0]) + "' with " + Counted(size, "number") +
                   ", expected " + std::to_string(least) +
                   (least == most ? "" : " to " + std::to_string(most)));
    }
    std::array<double, 3> vector = {};
    for (std::size_t i = 0; i < size; ++i) {
      if (Status status = ReadNumber(words_[i + 1], &vector[i]); !status.ok()) return status;
    }
    if (vectors == &textures_) texture_size_ = std::max(texture_size_, size);
    vectors->push_back(vector);
    return Status::Ok();
  }

  Status ReadNumber(std::string_view word, double* number) {
    const std::optional<double> value = ParseDouble(word);
    if (!value.has_value()) return Error(Quoted(word) + " is no number");
    *number = *value;
    return Status::Ok();
  }

  Status ReadFace() {
    for (std::size_t i = 1; i < words_.size(); ++i) {
      Corner corner = {kNone, kNone, kNone};
      if (Status status = ReadCorner(words_[i], &corner); !status.ok()) return status;
      corners_.push_back(corner);
    }
    face_sizes_.push_back(static_cast<std::uint32_t>(words_.size() - 1));
    face_lines_.push_back(line_);
    groups_.Add(group_);
    return Status::Ok();
  }

  Status ReadPolyline() {
    int previous = kNone;
    for (std::size_t i = 1; i < words_.size(); ++i) {
      Corner corner = {kNone, kNone, kNone};
      if (Status status = ReadCorner(words_[i], &corner); !status.ok()) return status;
      if (corner[0] >= static_cast<int>(vertices_.size())) {
        return Error("a line names vertex " + std::to_string(corner[0] + 1) + ", there are " +
                     std::to_string(vertices_.size()) + " so far");
      }
      if (i > 1) edges_.push_back({previous, corner[0]});
      previous = corner[0];
    }
    return Status::Ok();
  }

  // Reads `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`.
  Status ReadCorner(std::string_view word, Corner* corner) {
    const std::array<std::size_t, 3> counts = {vertices_.size(), textures_.size(), normals_.size()};
    std::size_t begin = 0;
    for (std::size_t part = 0; part < 3 && begin <= word.size(); ++part) {
      const std::size_t slash = std::min(word.find('/', begin), word.size());
      const std::string_view text = word.substr(begin, slash - begin);
      begin = slash + 1;
      if (text.empty() && part > 0) continue;
      long long index = 0;
      const char* const end = text.data() + text.size();
      const auto result = std::from_chars(text.data(), end, index);
      const auto count = static_cast<long long>(counts[part]);
      // Negative indices count back from the last line so far.
      if (index < 0) index += count + 1;
      if (result.ec != std::errc() || result.ptr != end || index < 1 || index > INT32_MAX) {
        return Error("a corner is " + Quoted(word) +
                     ", expected the number of a vertex from 1 on, or -1 and below");
      }
      (*corner)[part] = static_cast<int>(index - 1);
    }
    return Status::Ok();
  }

  // Faces may stand ahead of their vertices.
  Status CheckCorners() {
    const std::array<std::size_t, 3> counts = {vertices_.size(), textures_.size(), normals_.size()};
    constexpr std::array<const char*, 3> kNames = {"vertex ", "texture vertex ", "normal "};
    std::size_t corner = 0;
    for (std::size_t face = 0; face < face_sizes_.size(); ++face) {
      for (std::uint32_t i = 0; i < face_sizes_[face]; ++i, ++corner) {
        for (std::size_t part = 0; part < 3; ++part) {
          if (corners_[corner][part] < static_cast<long>(counts[part])) continue;
          line_ = face_lines_[face];
          return Error("a face names " + std::string(kNames[part]) +
                       std::to_string(corners_[corner][part] + 1) + ", the file has " +
                       std::to_string(counts[part]));
        }
      }
    }
    return Status::Ok();
  }

  void AddVertices() {
    PlyElement element;
    element.name = "vertex";
    element.count = vertices_.size();
    AppendArrays(vertices_, {"x", "y", "z"}, 3, &element);
    AddNormals(&element);
    AddColors(&element);
    document_.elements.push_back(std::move(element));
  }

  static void AppendArrays(const std::vector<std::array<double, 3>>& rows,
                           const std::array<const char*, 3>& names,
                           std::size_t size,
                           PlyElement* element) {
    for (std::size_t i = 0; i < size; ++i) {
      PlyProperty column = MakePlyScalar(names[i], PlyType::kFloat64);
      for (const std::array<double, 3>& row : rows) column.values.push_back(row[i]);
      element->properties.push_back(std::move(column));
    }
  }

  void AddNormals(PlyElement* element) {
    if (normals_.empty()) return;
    std::vector<int> normal_of(vertices_.size(), kNone);
    bool is_one = true;
    for (const Corner& corner : corners_) {
      int& normal = normal_of[static_cast<std::size_t>(corner[0])];
      const bool is_same =
          normal == corner[2] || (normal != kNone && corner[2] != kNone &&
                                  normals_[static_cast<std::size_t>(normal)] ==
                                      normals_[static_cast<std::size_t>(corner[2])]);
      is_one = is_one && (normal == kNone || is_same);
      normal = corner[2];
    }
    // Vertices without faces can have their normals in the same order.
    const bool is_parallel =
        normals_.size() == vertices_.size() &&
        std::all_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c[2] == c[0]; });
    if (is_parallel) {
      for (std::size_t i = 0; i < normal_of.size(); ++i) normal_of[i] = static_cast<int>(i);
    } else if (!is_one || corners_.empty()) {
      Warn("normals that differ between the corners at one vertex are left out");
      return;
    }
    std::vector<std::array<double, 3>> rows;
    rows.reserve(normal_of.size());
    for (const int normal : normal_of) {
      rows.push_back(normal == kNone ? std::array<double, 3>{}
                                     : normals_[static_cast<std::size_t>(normal)]);
    }
    AppendArrays(rows, {"nx", "ny", "nz"}, 3, element);
  }

  void AddColors(PlyElement* element) {
    if (colors_.empty()) return;
    if (colors_.size() != 3 * vertices_.size()) {
      Warn("colours are left out: only " + std::to_string(colors_.size() / 3) + " of " +
           Counted(vertices_.size(), "vertex") + " have one");
      return;
    }
    // Some programs write bytes.
    const bool are_bytes =
        std::any_of(colors_.begin(), colors_.end(), [](double value) { return value > 1.0; }) &&
        std::all_of(colors_.begin(), colors_.end(), [](double value) {
          return value >= 0.0 && value <= 255.0 && value == std::round(value);
        });
    if (are_bytes) {
      for (double& value : colors_) value /= 255.0;
    }
    AppendColors(colors_, 3, element);
  }

  void AddFaces() {
    if (face_sizes_.empty()) return;
    std::vector<double> vertices;
    for (const Corner& corner : corners_) vertices.push_back(corner[0]);
    AppendFaces(std::move(vertices), face_sizes_, &document_);
    AddTextures();
    groups_.AppendTo(&document_);
  }

  void AddTextures() {
    if (textures_.empty()) return;
    PlyProperty list = MakePlyList("texture_indices", PlyType::kUint32, PlyType::kInt32);
    const Corner* corner = corners_.data();
    for (const std::uint32_t size : face_sizes_) {
      const bool has_all =
          std::none_of(corner, corner + size, [](const Corner& c) { return c[1] == kNone; });
      list.list_sizes.push_back(has_all ? size : 0);
      for (std::uint32_t i = 0; has_all && i < size; ++i) list.values.push_back(corner[i][1]);
      corner += size;
    }
    document_.Find("face")->properties.push_back(std::move(list));
    PlyElement element;
    element.name = "texture_vertex";
    element.count = textures_.size();
    AppendArrays(textures_, {"u", "v", "w"}, texture_size_, &element);
    document_.elements.push_back(std::move(element));
  }

  void AddEdges() {
    if (edges_.empty()) return;
    PlyElement element;
    element.name = "edge";
    element.count = edges_.size();
    for (const std::size_t end : {0, 1}) {
      PlyProperty column = MakePlyScalar(end == 0 ? "vertex1" : "vertex2", PlyType::kInt32);
      for (const std::array<int, 2>& edge : edges_) column.values.push_back(edge[end]);
      element.properties.push_back(std::move(column));
    }
    document_.elements.push_back(std::move(element));
  }

  void AddWarnings() {
    if (weights_ > 0) Warn("the weights w of " + Counted(weights_, "vertex") + " are left out");
    for (const auto& [keyword, count] : skipped_) {
      Warn(Counted(count, "line") + " with the keyword " + Quoted(keyword) + " left out");
    }
  }

  void Warn(const std::string& what) { document_.warnings.push_back(what); }
  Status Error(const std::string& what) const {
    return Status::Error(path_ + ": line " + std::to_string(line_) + ": " + what);
  }

  const std::string& path_;
  int line_ = 0;
  std::string continued_;
  Words words_;
  PlyDocument document_;
  std::vector<std::array<double, 3>> vertices_;
  std::vector<std::array<double, 3>> normals_;
  std::vector<std::array<double, 3>> textures_;
  std::size_t texture_size_ = 0;
  std::vector<double> colors_;
  std::size_t weights_ = 0;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> face_sizes_;
  std::vector<int> face_lines_;
  std::vector<std::array<int, 2>> edges_;
  FaceGroup group_;
  FaceGroups groups_;
  std::map<std::string, std::size_t> skipped_;
};

}  // namespace

StatusOr<PlyDocument> ReadObj(const std::string& path) { return ObjReader(path).Read(); }

}  // namespace ceres_ed
