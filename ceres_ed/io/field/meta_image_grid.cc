// The grid in the header of a MetaImage file.
#include <ceres_ed/io/field/grid_reader.h>
#include <ceres_ed/io/field/header_fields.h>

#include <vector>

namespace ceres_ed {
namespace {

// Gives a field its first name if it stands in the header under another one.
void Rename(const std::vector<std::string>& names, HeaderFields* fields) {
  for (const std::string& name : names) {
    const auto found = fields->find(name);
    if (found != fields->end()) fields->emplace(names[0], found->second);
  }
}

}  // namespace

StatusOr<FieldGrid> ReadMetaImageGrid(const std::string& path) {
  StatusOr<HeaderFields> fields = ReadHeaderFields(path, '=', "ElementDataFile");
  if (!fields.ok()) return fields.status();
  Rename({"Offset", "Position", "Origin"}, &*fields);
  Rename({"TransformMatrix", "Rotation", "Orientation"}, &*fields);
  // What the format takes if they are missing.
  fields->emplace("Offset", "0 0 0");
  fields->emplace("TransformMatrix", "1 0 0 0 1 0 0 0 1");
  const StatusOr<std::vector<double>> sizes = NumbersOf(path, *fields, "DimSize", 3);
  if (!sizes.ok()) return sizes.status();
  const StatusOr<std::vector<double>> origin = NumbersOf(path, *fields, "Offset", 3);
  if (!origin.ok()) return origin.status();
  const StatusOr<std::vector<double>> spacing = NumbersOf(path, *fields, "ElementSpacing", 3);
  if (!spacing.ok()) return spacing.status();
  const StatusOr<std::vector<double>> axes = NumbersOf(path, *fields, "TransformMatrix", 9);
  if (!axes.ok()) return axes.status();
  return GridFromSteps(path,
                       {(*sizes)[0], (*sizes)[1], (*sizes)[2]},
                       Eigen::Map<const Eigen::Vector3d>(origin->data()),
                       Eigen::Map<const Eigen::Matrix3d>(axes->data()) *
                           Eigen::Map<const Eigen::Vector3d>(spacing->data()).asDiagonal());
}

}  // namespace ceres_ed
