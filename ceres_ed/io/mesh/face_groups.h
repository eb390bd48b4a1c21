// Names of parts of a mesh, as OBJ and STL files have them.
#ifndef CERES_ED_IO_MESH_FACE_GROUPS_H_
#define CERES_ED_IO_MESH_FACE_GROUPS_H_

#include <ceres_ed/io/mesh/ply_document.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace ceres_ed {

// What a face belongs to: the rest of the lines `o`, `g`, `s` and `usemtl` of an OBJ file that hold
// for it, empty where there is none. The name of an STL solid is that of an object.
struct FaceGroup {
  static constexpr std::array<const char*, 4> kKeywords = {"o", "g", "s", "usemtl"};
  std::array<std::string, 4> names;
  bool operator==(const FaceGroup& other) const { return names == other.names; }
};

// Collects the groups of faces in the order of the file. In a document they are an int property
// `group` of the faces, and an obj_info line `group NUMBER KEYWORD NAME` for each name.
class FaceGroups {
 public:
  // Reads the groups of a document; groups without names if it has no such property.
  static FaceGroups Of(const PlyDocument& document);

  // Says to which group the next face belongs.
  void Add(const FaceGroup& group);
  // Adds the property and the lines, unless no group has a name. The document must have the faces.
  void AppendTo(PlyDocument* document) const;
  // Returns the group of a face.
  const FaceGroup& GroupOf(std::size_t face) const;

 private:
  std::vector<FaceGroup> groups_ = {FaceGroup()};
  std::map<std::array<std::string, 4>, std::size_t> number_of_ = {{FaceGroup().names, 0}};
  std::size_t current_ = 0;
  std::vector<double> of_faces_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_FACE_GROUPS_H_
