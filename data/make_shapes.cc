// Writes a family of shapes with known modes of variation: make_shapes FOLDER [SHAPES [VERTICES
// [groups]]]. FOLDER gets template.ply, shapes.csv with the shapes in shapes/, and truth.npy (N x V
// x 3: where the vertices of the template are on each shape).
#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/npy_rows.h>
#include <ceres_ed/simulation/shape_family.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

using ceres_ed::ShapeFamily;
using ceres_ed::Status;

Status WriteFamily(const std::string& folder, const ShapeFamily& family, bool groups) {
  std::filesystem::create_directories(folder + "/shapes");
  Status status = ceres_ed::WriteCloud(folder + "/template.ply", family.source());
  const auto shapes = static_cast<std::size_t>(family.size());
  auto truth =
      ceres_ed::NpyRowsWriter::Create(folder + "/truth.npy", {shapes, family.source().size(), 3});
  if (!truth.ok()) return truth.status();
  std::string table = groups ? "name,path,group\n" : "name,path\n";
  for (int i = 0; i < family.size() && status.ok(); ++i) {
    char name[32];
    std::snprintf(name, sizeof(name), "shape_%04d", i);
    const std::string file = std::string("shapes/") + name + ".ply";
    status = ceres_ed::WriteCloud(folder + "/" + file, family.Shape(i));
    const std::vector<Eigen::Vector3d> points = family.Truth(i);
    if (status.ok()) status = (*truth)->Write(i, points.front().data());
    table += std::string(name) + "," + file;
    if (groups) table += i < family.size() / 2 ? ",straight" : ",bent";
    table += "\n";
  }
  if (status.ok()) status = (*truth)->Commit();
  return status.ok() ? ceres_ed::WriteFileAtomically(folder + "/shapes.csv", table) : status;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: make_shapes FOLDER [SHAPES [VERTICES [groups]]]\n");
    return 1;
  }
  ceres_ed::ShapeFamilyOptions options;
  if (argc > 2) options.shapes = std::atoi(argv[2]);
  if (argc > 3) options.vertices = std::atoi(argv[3]);
  options.groups = argc > 4;
  if (options.shapes < 1 || options.vertices < 500) {
    std::fprintf(stderr, "make_shapes: expected at least 1 shape and 500 vertices\n");
    return 1;
  }
  const Status status = WriteFamily(argv[1], ShapeFamily(options), options.groups);
  if (status.ok()) return 0;
  std::fprintf(stderr, "make_shapes: %s\n", status.message().c_str());
  return 2;
}
