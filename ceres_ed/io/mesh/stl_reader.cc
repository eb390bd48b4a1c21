// The readers of assimp and VTK would give the same floats, but only with a library of 10 or 105 MB
// for what are 50 bytes a triangle.
#include <ceres_ed/io/mesh/byte_order.h>
#include <ceres_ed/io/mesh/face_groups.h>
#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/mesh/stl_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

constexpr std::size_t kHeaderSize = 80;
constexpr std::size_t kFirstTriangle = 84;
constexpr std::size_t kTriangleSize = 50;

template <typename T>
T LittleEndian(const char* bytes) {
  return HostIsLittleEndian() ? NumberFromBytes<T, false>(bytes) : NumberFromBytes<T, true>(bytes);
}

// The bits of three floats, so that a NaN is equal to itself.
using Place = std::array<std::uint32_t, 3>;
struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    std::uint64_t hash = 1469598103934665603ULL;
    for (const std::uint32_t word : place) hash = (hash ^ word) * 1099511628211ULL;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

// Gives equal corners one vertex.
class Welder {
 public:
  void Add(const std::array<float, 3>& corner) {
    Place place;
    std::memcpy(place.data(), corner.data(), sizeof(place));
    // -0 and 0 are the same place.
    for (std::uint32_t& word : place) word = word == 0x80000000U ? 0U : word;
    const auto [entry, is_new] =
        vertex_at_.insert({place, static_cast<std::uint32_t>(vertices_.size())});
    if (is_new) vertices_.push_back(corner);
    corners_.push_back(entry->second);
  }

  std::size_t NumTriangles() const { return corners_.size() / 3; }

  void AppendTo(PlyDocument* document) && {
    PlyElement element;
    element.name = "vertex";
    element.count = vertices_.size();
    constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      PlyProperty column = MakePlyScalar(kNames[axis], PlyType::kFloat32);
      for (const std::array<float, 3>& vertex : vertices_) column.values.push_back(vertex[axis]);
      element.properties.push_back(std::move(column));
    }
    document->elements.push_back(std::move(element));
    std::vector<std::uint32_t> sizes(NumTriangles(), 3);
    AppendFaces(std::move(corners_), std::move(sizes), document);
  }

 private:
  std::unordered_map<Place, std::uint32_t, PlaceHash> vertex_at_;
  std::vector<std::array<float, 3>> vertices_;
  std::vector<double> corners_;
};

StatusOr<PlyDocument> ReadBinary(const std::string& path, std::string_view bytes) {
  PlyDocument document;
  if (bytes.size() < kFirstTriangle) {
    return Status::Error(path + ": " + std::to_string(bytes.size()) +
                         " bytes, expected an STL: 'solid', or a header of 84 bytes");
  }
  const std::size_t count = LittleEndian<std::uint32_t>(bytes.data() + kHeaderSize);
  const std::size_t size = kFirstTriangle + count * kTriangleSize;
  if (bytes.size() < size) {
    return Status::Error(path + ": truncated: a file of " + Counted(count, "triangle") + " has " +
                         std::to_string(size) + " bytes, this one " + std::to_string(bytes.size()));
  }
  if (bytes.size() > size) {
    document.warnings.push_back(Counted(bytes.size() - size, "byte") +
                                " behind the last triangle left out");
  }
  Welder welder;
  PlyProperty attributes = MakePlyScalar("attribute", PlyType::kUint16);
  const char* triangle = bytes.data() + kFirstTriangle;
  for (std::size_t i = 0; i < count; ++i, triangle += kTriangleSize) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      std::array<float, 3> place = {};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        place[axis] = LittleEndian<float>(triangle + 12 * corner + 4 * axis);
      }
      welder.Add(place);
    }
    attributes.values.push_back(LittleEndian<std::uint16_t>(triangle + 48));
  }
  std::move(welder).AppendTo(&document);
  const bool has_attributes = std::any_of(
      attributes.values.begin(), attributes.values.end(), [](double bits) { return bits != 0.0; });
  if (has_attributes) document.Find("face")->properties.push_back(std::move(attributes));
  return document;
}

class AsciiReader {
 public:
  AsciiReader(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  StatusOr<PlyDocument> Read() {
    for (const std::string_view line : SplitLines(text_, '\n')) {
      ++line_;
      if (Status status = ReadLine(Trim(line)); !status.ok()) return status;
    }
    if (corner_ != 0 || in_loop_) return Error("truncated: the last triangle is not complete");
    PlyDocument document;
    document.format = PlyFormat::kAscii;
    std::move(welder_).AppendTo(&document);
    groups_.AppendTo(&document);
    return document;
  }

 private:
  Status ReadLine(std::string_view line) {
    const std::vector<std::string_view> words = SplitWords(line, " \t\r");
    if (words.empty()) return Status::Ok();
    if (words[0] == "vertex") return ReadVertex(words);
    if (words[0] == "solid") {
      group_.names[0] = std::string(Trim(line.substr(words[0].size())));
      return Status::Ok();
    }
    if (words[0] == "outer") return StartLoop();
    if (words[0] == "endloop") return EndLoop();
    for (const char* const known : {"facet", "endfacet", "endsolid"}) {
      if (words[0] == known) return Status::Ok();
    }
    return Error("the line begins with " + Quoted(words[0]) +
                 ", expected solid, facet, outer loop, vertex, endloop, endfacet or endsolid");
  }

  Status StartLoop() {
    if (in_loop_) return Error("a loop begins in a loop");
    in_loop_ = true;
    return Status::Ok();
  }

  Status EndLoop() {
    if (!in_loop_ || corner_ != 3) {
      return Error("a loop of " + std::to_string(corner_) + " vertices ends, expected 3");
    }
    for (const std::array<float, 3>& corner : triangle_) welder_.Add(corner);
    groups_.Add(group_);
    corner_ = 0;
    in_loop_ = false;
    return Status::Ok();
  }

  Status ReadVertex(const std::vector<std::string_view>& words) {
    if (!in_loop_ || corner_ == 3) return Error("a vertex beside the three of a loop");
    if (words.size() != 4) return Error("a vertex without three coordinates");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::optional<double> value = ParseDouble(words[axis + 1]);
      if (!value.has_value()) return Error(Quoted(words[axis + 1]) + " is no number");
      triangle_[corner_][axis] = static_cast<float>(*value);
    }
    ++corner_;
    return Status::Ok();
  }

  Status Error(const std::string& what) const {
    return Status::Error(path_ + ": line " + std::to_string(line_) + ": " + what);
  }

  const std::string& path_;
  std::string_view text_;
  int line_ = 0;
  Welder welder_;
  FaceGroup group_;
  FaceGroups groups_;
  std::array<std::array<float, 3>, 3> triangle_ = {};
  std::size_t corner_ = 0;
  bool in_loop_ = false;
};

}  // namespace

bool HasSizeOfBinaryStl(std::string_view start, std::size_t size) {
  if (start.size() < kFirstTriangle) return false;
  const std::size_t count = LittleEndian<std::uint32_t>(start.data() + kHeaderSize);
  return size == kFirstTriangle + count * kTriangleSize;
}

StatusOr<PlyDocument> ReadStl(const std::string& path) {
  const StatusOr<std::string> bytes = ReadWholeFile(path);
  if (!bytes.ok()) return bytes.status();
  const bool is_ascii =
      Trim(*bytes).substr(0, 5) == "solid" && !HasSizeOfBinaryStl(*bytes, bytes->size());
  return is_ascii ? AsciiReader(path, *bytes).Read() : ReadBinary(path, *bytes);
}

}  // namespace ceres_ed
