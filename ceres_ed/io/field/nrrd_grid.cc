// The grid in the header of a NRRD file.
#include <ceres_ed/io/field/grid_reader.h>
#include <ceres_ed/io/field/header_fields.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <vector>

namespace ceres_ed {
namespace {

// Returns the signs that make left-posterior-superior coordinates of those of the file.
StatusOr<Eigen::Vector3d> LpsFromSpace(const std::string& path, const HeaderFields& fields) {
  const auto found = fields.find("space");
  const std::string space = found == fields.end() ? "" : found->second;
  if (space == "left-posterior-superior" || space == "LPS") return Eigen::Vector3d(1, 1, 1);
  if (space == "right-anterior-superior" || space == "RAS") return Eigen::Vector3d(-1, -1, 1);
  if (space == "left-anterior-superior" || space == "LAS") return Eigen::Vector3d(1, -1, 1);
  return Status::Error(path + ": the field 'space' is " +
                       (space.empty() ? "missing" : Quoted(space)) +
                       ", expected left-posterior-superior, right-anterior-superior or "
                       "left-anterior-superior");
}

// Returns the sizes of the axes that lie in space: "none" stands for the others among the
// directions.
StatusOr<std::vector<double>> SpatialSizes(const std::string& path, const HeaderFields& fields) {
  const auto directions = fields.find("space directions");
  std::vector<bool> is_spatial;
  std::string text = directions == fields.end() ? "" : directions->second;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '(') is_spatial.push_back(true);
    if (text.compare(at, 4, "none") == 0) is_spatial.push_back(false);
  }
  if (is_spatial.empty()) is_spatial.assign(3, true);
  const StatusOr<std::vector<double>> sizes = NumbersOf(path, fields, "sizes", is_spatial.size());
  if (!sizes.ok()) return sizes.status();
  std::vector<double> spatial;
  for (std::size_t axis = 0; axis < is_spatial.size(); ++axis) {
    if (is_spatial[axis]) spatial.push_back((*sizes)[axis]);
  }
  if (spatial.size() == 3) return spatial;
  return Status::Error(path + ": " + std::to_string(spatial.size()) + " axes in space, expected 3");
}

}  // namespace

StatusOr<FieldGrid> ReadNrrdGrid(const std::string& path) {
  const StatusOr<HeaderFields> fields = ReadHeaderFields(path, ':', "");
  if (!fields.ok()) return fields.status();
  const StatusOr<Eigen::Vector3d> signs = LpsFromSpace(path, *fields);
  if (!signs.ok()) return signs.status();
  const StatusOr<std::vector<double>> sizes = SpatialSizes(path, *fields);
  if (!sizes.ok()) return sizes.status();
  const StatusOr<std::vector<double>> steps = NumbersOf(path, *fields, "space directions", 9);
  if (!steps.ok()) return steps.status();
  const StatusOr<std::vector<double>> origin = NumbersOf(path, *fields, "space origin", 3);
  if (!origin.ok()) return origin.status();
  return GridFromSteps(path,
                       {(*sizes)[0], (*sizes)[1], (*sizes)[2]},
                       signs->cwiseProduct(Eigen::Map<const Eigen::Vector3d>(origin->data())),
                       signs->asDiagonal() * Eigen::Map<const Eigen::Matrix3d>(steps->data()));
}

}  // namespace ceres_ed
