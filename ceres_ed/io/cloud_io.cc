#include "ceres_ed/io/cloud_io.h"

#include <ceres_ed/geometry/polygon_triangles.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/mesh/vertex_columns.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace ceres_ed {
namespace {

bool IsUsableCoordinate(const Eigen::Vector3d& point) {
  // The comparison is false for NaN.
  return point.cwiseAbs().maxCoeff() <= kMaxCoordinate && point.allFinite();
}

class CloudBuilder {
 public:
  CloudBuilder(const std::string& path, PlyDocument document) : path_(path) {
    loaded_.document = std::move(document);
    for (const std::string& warning : loaded_.document.warnings) Warn(warning);
  }

  StatusOr<LoadedCloud> Build() {
    vertices_ = loaded_.document.Find("vertex");
    Status status = AddPoints();
    if (!status.ok()) return status;
    AddNormals();
    AddIntensities();
    status = AddTriangles();
    if (!status.ok()) return status;
    return std::move(loaded_);
  }

 private:
  Status AddPoints() {
    if (vertices_ == nullptr) return Error("no element 'vertex'");
    if (vertices_->count == 0) return Error("no vertices, expected at least one");
    if (vertices_->count > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      return Error(std::to_string(vertices_->count) + " vertices, at most 2147483647 can be used");
    }
    const std::optional<VertexColumns> columns = FindPositionColumns(*vertices_);
    if (!columns.has_value()) {
      std::string names;
      for (const PlyProperty& property : vertices_->properties) {
        names += (names.empty() ? "" : " ") + property.name;
      }
      return Error("element 'vertex' has the properties '" + names + "', expected x y z");
    }
    point_of_vertex_.assign(vertices_->count, -1);
    loaded_.cloud.points.reserve(vertices_->count);
    loaded_.vertex_of_point.reserve(vertices_->count);
    for (std::size_t row = 0; row < vertices_->count; ++row) {
      const Eigen::Vector3d point = RowOf(*vertices_, *columns, row);
      if (!IsUsableCoordinate(point)) continue;
      point_of_vertex_[row] = static_cast<int>(loaded_.cloud.points.size());
      loaded_.vertex_of_point.push_back(static_cast<int>(row));
      loaded_.cloud.points.push_back(point);
    }
    const std::size_t dropped = vertices_->count - loaded_.cloud.size();
    // Sensors write a vertex for each pixel, of which most may be without depth.
    if (dropped == vertices_->count) {
      return Error("none of the " + std::to_string(vertices_->count) +
                   " vertices has finite coordinates");
    }
    if (dropped > 0) {
      const std::string most =
          2 * dropped > vertices_->count ? " (of " + std::to_string(vertices_->count) + ")" : "";
      Warn(Counted(dropped, "point") + most + " with coordinates that are not finite dropped");
    }
    return Status::Ok();
  }

  void AddNormals() {
    const std::optional<VertexColumns> columns = FindNormalColumns(*vertices_);
    if (!columns.has_value()) return;
    std::vector<Eigen::Vector3d>& normals = loaded_.cloud.normals;
    normals.reserve(loaded_.cloud.size());
    std::size_t bad = 0;
    for (const int row : loaded_.vertex_of_point) {
      const Eigen::Vector3d normal = RowOf(*vertices_, *columns, static_cast<std::size_t>(row));
      const double length = normal.stableNorm();
      const bool usable = std::isfinite(length) && length > 0.0;
      if (!usable) ++bad;
      normals.push_back(usable ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero());
    }
    if (bad == normals.size()) {
      normals.clear();
      Warn("all normals are zero or not finite and were left out");
    } else if (bad > 0) {
      Warn(Counted(bad, "normal") + " of zero length or not finite");
    }
  }

  void AddIntensities() {
    const std::optional<VertexColumns> columns = FindColorColumns(*vertices_);
    if (!columns.has_value()) return;
    // Rec. 601 luma.
    const Eigen::Vector3d luminance(0.299, 0.587, 0.114);
    const Eigen::Vector3d share = luminance / WhiteOf(*columns);
    loaded_.cloud.intensities.reserve(loaded_.cloud.size());
    for (const int row : loaded_.vertex_of_point) {
      const double value = share.dot(RowOf(*vertices_, *columns, static_cast<std::size_t>(row)));
      loaded_.cloud.intensities.push_back(std::isfinite(value)
                                              ? std::clamp(value, 0.0, 1.0)
                                              : std::numeric_limits<double>::quiet_NaN());
    }
  }

  // Returns the value of full brightness. The type tells it for bytes alone: floats may reach 1, or
  // 255 as in the bytes that they come from, and these may stand in wider integers. The whole of
  // the three columns decides, so that a dark vertex has the range of its neighbours.
  double WhiteOf(const VertexColumns& columns) {
    double largest = 0.0;
    for (const std::size_t column : columns) {
      for (const double value : vertices_->properties[column].values) {
        if (std::isfinite(value)) largest = std::max(largest, value);
      }
    }
    const PlyType type = vertices_->properties[columns[0]].type;
    const double usual = LargestColor(type);
    if (type == PlyType::kUint8 || type == PlyType::kInt8) return usual;
    const bool is_float = type == PlyType::kFloat32 || type == PlyType::kFloat64;
    // Highlights may be computed beyond full brightness; bytes that all are this dark show nothing.
    constexpr double kBrightest = 16.0;
    if (is_float && largest <= kBrightest) return usual;
    for (const double white : {255.0, 65535.0}) {
      if (largest > white || white == usual) continue;
      std::ostringstream text;
      text << "the largest colour is " << largest << ": colours are taken as 0 to " << white;
      Warn(text.str());
      return white;
    }
    return std::max(usual, largest);
  }

  // Triangles 0 1 2, 2 1 3, 2 3 4, ... of strips of vertices, which -1 separates. Corners that
  // repeat join two strips and are no triangles.
  Status AddStrips(const PlyElement& strips) {
    const PlyProperty* const vertices = strips.Find("vertex_indices");
    if (vertices == nullptr || !vertices->is_list) {
      return Error("element 'tristrips' has no list 'vertex_indices'");
    }
    const double* strip = vertices->values.data();
    for (std::size_t row = 0; row < strips.count; ++row) {
      const std::size_t size = vertices->list_sizes[row];
      std::size_t begin = 0;
      for (std::size_t i = 0; i < size; ++i) {
        if (strip[i] == -1.0) {
          begin = i + 1;
          continue;
        }
        if (!IsVertex(strip[i])) return IndexError("strip", row, strip[i]);
        if (i < begin + 2) continue;
        const bool is_odd = (i - begin) % 2 != 0;
        const double a = strip[is_odd ? i - 1 : i - 2];
        const double b = strip[is_odd ? i - 2 : i - 1];
        if (a != b && b != strip[i] && strip[i] != a) AddTriangle(a, b, strip[i]);
      }
      strip += size;
    }
    WarnOfDroppedFaces();
    return Status::Ok();
  }

  Status AddTriangles() {
    const PlyElement* const faces = loaded_.document.Find("face");
    if (faces == nullptr || faces->count == 0) {
      const PlyElement* const strips = loaded_.document.Find("tristrips");
      return strips != nullptr ? AddStrips(*strips) : Status::Ok();
    }
    const PlyProperty* corners = faces->Find("vertex_indices");
    if (corners == nullptr) corners = faces->Find("vertex_index");
    if (corners == nullptr || !corners->is_list) {
      return Error("element 'face' has no list 'vertex_indices' or 'vertex_index'");
    }
    loaded_.cloud.triangles.reserve(faces->count);
    const double* polygon = corners->values.data();
    for (std::size_t face = 0; face < faces->count; ++face) {
      const std::size_t size = corners->list_sizes[face];
      for (std::size_t i = 0; i < size; ++i) {
        if (!IsVertex(polygon[i])) return IndexError("face", face, polygon[i]);
      }
      if (size < 3) ++small_polygons_;
      AddPolygon(polygon, size);
      polygon += size;
    }
    WarnOfDroppedFaces();
    return Status::Ok();
  }

  bool IsVertex(double index) const {
    return index >= 0.0 && index < static_cast<double>(vertices_->count) &&
           index == std::floor(index);
  }

  // Adds the triangles of a polygon. One with corners that were left out is a fan.
  void AddPolygon(const double* polygon, std::size_t size) {
    std::vector<Eigen::Vector3d> corners;
    for (std::size_t i = 0; i < size && size > 3; ++i) {
      const int point = point_of_vertex_[static_cast<std::size_t>(polygon[i])];
      if (point >= 0) corners.push_back(loaded_.cloud.points[point]);
    }
    if (size > 3 && corners.size() == size) {
      for (const std::array<int, 3>& t : PolygonTriangles(corners)) {
        AddTriangle(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
      }
      return;
    }
    for (std::size_t i = 2; i < size; ++i) AddTriangle(polygon[0], polygon[i - 1], polygon[i]);
  }

  void AddTriangle(double a, double b, double c) {
    if (a == b || b == c || c == a) {
      ++degenerate_triangles_;
      return;
    }
    const std::array<int, 3> triangle = {point_of_vertex_[static_cast<std::size_t>(a)],
                                         point_of_vertex_[static_cast<std::size_t>(b)],
                                         point_of_vertex_[static_cast<std::size_t>(c)]};
    if (triangle[0] < 0 || triangle[1] < 0 || triangle[2] < 0) {
      ++orphan_triangles_;
      return;
    }
    loaded_.cloud.triangles.push_back(triangle);
  }

  void WarnOfDroppedFaces() {
    if (small_polygons_ > 0) {
      Warn(Counted(small_polygons_, "face") + " of fewer than three corners dropped");
    }
    if (degenerate_triangles_ > 0) {
      Warn(Counted(degenerate_triangles_, "triangle") + " with a repeated corner dropped");
    }
    if (orphan_triangles_ > 0) {
      Warn(Counted(orphan_triangles_, "triangle") + " on dropped points dropped");
    }
  }

  Status IndexError(const std::string& what, std::size_t row, double index) const {
    const bool whole = index == std::floor(index) && std::abs(index) < 1e15;
    const std::string name =
        whole ? std::to_string(static_cast<long long>(index)) : std::to_string(index);
    return Error(what + ' ' + std::to_string(row) + " names vertex " + name + ", the file has " +
                 std::to_string(vertices_->count));
  }

  Status Error(const std::string& what) const { return Status::Error(path_ + ": " + what); }
  void Warn(const std::string& what) { loaded_.warnings.push_back(path_ + ": " + what); }

  std::string path_;
  LoadedCloud loaded_;
  const PlyElement* vertices_ = nullptr;
  // -1 for a vertex that was left out.
  std::vector<int> point_of_vertex_;
  std::size_t small_polygons_ = 0;
  std::size_t degenerate_triangles_ = 0;
  std::size_t orphan_triangles_ = 0;
};

}  // namespace

StatusOr<LoadedCloud> CloudFromDocument(const std::string& path, PlyDocument document) {
  return CloudBuilder(path, std::move(document)).Build();
}

StatusOr<LoadedCloud> LoadCloud(const std::string& path) {
  StatusOr<PlyDocument> document = ReadMesh(path);
  if (!document.ok()) return document.status();
  return CloudFromDocument(path, *std::move(document));
}

}  // namespace ceres_ed
