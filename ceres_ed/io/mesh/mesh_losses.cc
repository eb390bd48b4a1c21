#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <map>

namespace ceres_ed {
namespace {

constexpr std::string_view kPositions = "x y z";
constexpr std::string_view kCorners = "vertex_indices vertex_index";

bool HasWord(std::string_view words, const std::string& word) {
  const std::vector<std::string_view> all = SplitWords(words, " ");
  return std::find(all.begin(), all.end(), word) != all.end();
}

class Losses {
 public:
  Losses(const std::string& path, const MeshFormat& format, const PlyDocument& document)
      : path_(path), format_(format), document_(document) {}

  std::vector<std::string> Find() {
    const StatusOr<MeshView> view = MeshView::Of(path_, document_);
    if (!view.ok()) return {};
    const MeshAbilities& can = format_.abilities;
    if (!can.doubles && view->HasDoubles()) {
      Say("holds floats: the coordinates, which are doubles, are rounded");
    }
    if (!can.polygons) FindPolygons(*view);
    if (!can.has_vertex_list) FindVertexOrder(*view);
    FindColumns("vertex", view->vertices(), can.vertex_data, kPositions);
    const bool is_ascii = document_.format == PlyFormat::kAscii && !can.ascii_face_data.empty();
    const std::string_view face_data = is_ascii ? can.ascii_face_data : can.face_data;
    if (view->faces() != nullptr) FindColumns("face", *view->faces(), face_data, kCorners);
    FindElements(can.elements);
    return std::move(sentences_);
  }

 private:
  void FindPolygons(const MeshView& view) {
    std::size_t polygons = 0;
    for (std::size_t face = 0; face < view.NumFaces(); ++face) {
      polygons += view.FaceSize(face) > 3 ? 1 : 0;
    }
    if (polygons > 0) {
      Say("holds triangles: " + Counted(polygons, "face") + " of more corners " +
          (polygons == 1 ? "is" : "are") + " cut");
    }
  }

  // A reader finds the vertices again in the order in which the triangles use them, and those at
  // one place as one.
  void FindVertexOrder(const MeshView& view) {
    const std::size_t count = view.vertices().count;
    std::vector<char> is_used(count, 0);
    std::map<std::array<float, 3>, std::size_t> at;
    bool is_kept = true;
    std::size_t used = 0;
    for (std::size_t face = 0; face < view.NumFaces(); ++face) {
      for (std::size_t i = 0; i < view.FaceSize(face); ++i) {
        const std::size_t row = view.Corner(face, i);
        if (is_used[row] != 0) continue;
        is_used[row] = 1;
        const Eigen::Vector3f place = view.Point(row).cast<float>();
        // A NaN has no place in an ordered map.
        const bool is_new =
            !place.allFinite() || at.insert({{place.x(), place.y(), place.z()}, row}).second;
        is_kept = is_kept && row == used && is_new;
        ++used;
      }
    }
    if (used < count) {
      Say("holds triangles alone: " + Counted(count - used, "vertex") + " that no face uses " +
          (count - used == 1 ? "is" : "are") + " left out");
    }
    if (!is_kept) {
      Say("has no list of vertices: their order is lost, and those at one place become one");
    }
  }

  void FindColumns(const char* of,
                   const PlyElement& element,
                   std::string_view kept,
                   std::string_view always) {
    std::string names;
    for (const PlyProperty& property : element.properties) {
      const bool is_scalar_of_all = kept == "*" && !property.is_list;
      if (is_scalar_of_all || HasWord(kept, property.name) || HasWord(always, property.name)) {
        continue;
      }
      names += ' ' + property.name;
    }
    if (!names.empty()) Say(std::string("cannot hold the ") + of + " properties" + names);
  }

  void FindElements(std::string_view kept) {
    if (kept == "*") return;
    for (const PlyElement& element : document_.elements) {
      const bool is_mesh = element.name == "vertex" || element.name == "face";
      if (is_mesh || element.count == 0 || HasWord(kept, element.name)) continue;
      Say("cannot hold the " + std::to_string(element.count) + " rows of element '" + element.name +
          "'");
    }
  }

  void Say(const std::string& what) {
    sentences_.push_back(path_ + ": the format " + format_.name + ' ' + what);
  }

  const std::string& path_;
  const MeshFormat& format_;
  const PlyDocument& document_;
  std::vector<std::string> sentences_;
};

}  // namespace

Status CheckHolds(const std::string& path, const PlyDocument& document) {
  const MeshFormat* const format = FindMeshFormat(path);
  if (format == nullptr) return CheckMeshEnding(path);
  const PlyElement* const faces = document.Find("face");
  const bool has_faces = faces != nullptr && faces->count > 0;
  if (has_faces && !format->abilities.faces) {
    return Status::Error(path + ": the format " + format->name +
                         " holds points alone, and the mesh has " + Counted(faces->count, "face") +
                         ", expected a name that ends in .ply");
  }
  if (!has_faces && !format->abilities.has_vertex_list) {
    return Status::Error(path + ": the format " + format->name +
                         " holds triangles alone, and there are no faces, expected a name that "
                         "ends in .ply");
  }
  return Status::Ok();
}

std::vector<std::string> LossesOf(const std::string& path, const PlyDocument& document) {
  const MeshFormat* const format = FindMeshFormat(path);
  // A PLY holds everything.
  if (format == nullptr || format == FindMeshFormat("a.ply")) return {};
  return Losses(path, *format, document).Find();
}

}  // namespace ceres_ed
