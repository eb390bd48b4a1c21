// The numbers of an accessor of glTF.
#ifndef CERES_ED_GLTF_GLB_ATTRIBUTES_H_
#define CERES_ED_GLTF_GLB_ATTRIBUTES_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace ceres_ed {

// The values of an accessor, one row after the other.
struct AttributeValues {
  std::size_t components = 1;
  std::size_t count = 0;
  // Integers that are marked as normalised are divided by the largest of their type.
  std::vector<double> values;
  // The type of a column that can hold them.
  PlyType type = PlyType::kFloat32;
};

// Reads the accessor number `index`. The error is a sentence without the name of the file: there is
// no such accessor, it leads outside of the data, or it is sparse.
StatusOr<AttributeValues> ReadAccessor(const tinygltf::Model& model, int index);

// The name of an accessor from which the type of its column is known again.
std::string AccessorNameOf(PlyType type);
std::optional<PlyType> TypeOfAccessorName(const std::string& name);

}  // namespace ceres_ed

#endif  // CERES_ED_GLTF_GLB_ATTRIBUTES_H_
