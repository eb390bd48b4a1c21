#include "ceres_ed/io/mesh/mesh_view.h"

#include <ceres_ed/geometry/polygon_triangles.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {

StatusOr<MeshView> MeshView::Of(const std::string& path, const PlyDocument& document) {
  MeshView view;
  view.vertices_ = document.Find("vertex");
  if (view.vertices_ == nullptr) return Status::Error(path + ": no element 'vertex' to write");
  const std::optional<VertexColumns> positions = FindPositionColumns(*view.vertices_);
  if (!positions.has_value()) return Status::Error(path + ": the vertices to write have no x y z");
  view.positions_ = *positions;
  view.begins_.push_back(0);
  view.faces_ = document.Find("face");
  if (view.faces_ != nullptr) view.corners_ = FindCorners(*view.faces_);
  if (view.corners_ == nullptr) view.faces_ = nullptr;
  if (view.faces_ == nullptr) return view;
  for (const std::uint32_t size : view.corners_->list_sizes) {
    view.begins_.push_back(view.begins_.back() + size);
  }
  const auto count = static_cast<double>(view.vertices_->count);
  const bool in_range = std::all_of(
      view.corners_->values.begin(), view.corners_->values.end(), [count](double index) {
        return index >= 0.0 && index < count && index == std::floor(index);
      });
  if (!in_range) return Status::Error(path + ": a face to write names a vertex that is not there");
  return view;
}

bool MeshView::HasDoubles() const {
  return std::any_of(positions_.begin(), positions_.end(), [this](std::size_t column) {
    const PlyProperty& property = vertices_->properties[column];
    if (property.type != PlyType::kFloat64 && property.type != PlyType::kInt32 &&
        property.type != PlyType::kUint32) {
      return false;
    }
    return std::any_of(property.values.begin(), property.values.end(), [](double value) {
      return std::isfinite(value) && static_cast<double>(static_cast<float>(value)) != value;
    });
  });
}

std::vector<std::array<std::size_t, 3>> MeshView::TrianglesOf(std::size_t face) const {
  const std::size_t size = FaceSize(face);
  if (size == 3) return {{Corner(face, 0), Corner(face, 1), Corner(face, 2)}};
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < size; ++i) points.push_back(Point(Corner(face, i)));
  const bool is_finite = std::all_of(
      points.begin(), points.end(), [](const Eigen::Vector3d& p) { return p.allFinite(); });
  if (!is_finite) points.assign(size, Eigen::Vector3d::Zero());
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const std::array<int, 3>& cut : PolygonTriangles(points)) {
    std::array<std::size_t, 3> triangle = {};
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = Corner(face, static_cast<std::size_t>(cut[i]));
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

const PlyProperty* FindCorners(const PlyElement& faces) {
  const PlyProperty* corners = faces.Find("vertex_indices");
  if (corners == nullptr) corners = faces.Find("vertex_index");
  return corners != nullptr && corners->is_list ? corners : nullptr;
}

std::optional<ColorColumns> FindColors(const PlyElement& element) {
  const std::optional<VertexColumns> rgb = FindColorColumns(element);
  if (!rgb.has_value()) return std::nullopt;
  ColorColumns columns;
  columns.rgb = *rgb;
  if (const PlyProperty* const alpha = element.Find("alpha"); alpha != nullptr && !alpha->is_list) {
    columns.alpha = static_cast<std::size_t>(alpha - element.properties.data());
  }
  return columns;
}

double LargestColor(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
      return 127.0;
    case PlyType::kUint8:
      return 255.0;
    case PlyType::kInt16:
      return 32767.0;
    case PlyType::kUint16:
      return 65535.0;
    case PlyType::kInt32:
      return 2147483647.0;
    case PlyType::kUint32:
      return 4294967295.0;
    case PlyType::kFloat32:
    case PlyType::kFloat64:
      break;
  }
  return 1.0;
}

void AppendFaces(std::vector<double> corners,
                 std::vector<std::uint32_t> sizes,
                 PlyDocument* document) {
  constexpr std::uint32_t kLargestByte = 255;
  const bool fit_bytes = std::all_of(
      sizes.begin(), sizes.end(), [](std::uint32_t size) { return size <= kLargestByte; });
  PlyElement faces;
  faces.name = "face";
  faces.count = sizes.size();
  PlyProperty property = MakePlyList(
      "vertex_indices", fit_bytes ? PlyType::kUint8 : PlyType::kUint32, PlyType::kInt32);
  property.values = std::move(corners);
  property.list_sizes = std::move(sizes);
  faces.properties.push_back(std::move(property));
  document->elements.push_back(std::move(faces));
}

void AppendColors(const std::vector<double>& values, std::size_t channels, PlyElement* element) {
  constexpr std::array<const char*, 4> kNames = {"red", "green", "blue", "alpha"};
  constexpr double kByte = 255.0;
  // Files with six digits are that close.
  constexpr double kTolerance = 1e-3;
  const bool are_bytes = std::all_of(values.begin(), values.end(), [](double value) {
    const double scaled = kByte * value;
    return scaled >= -kTolerance && scaled <= kByte + kTolerance &&
           std::abs(scaled - std::round(scaled)) <= kTolerance;
  });
  for (std::size_t channel = 0; channel < channels; ++channel) {
    PlyProperty column =
        MakePlyScalar(kNames[channel], are_bytes ? PlyType::kUint8 : PlyType::kFloat64);
    column.values.reserve(values.size() / channels);
    for (std::size_t i = channel; i < values.size(); i += channels) {
      column.values.push_back(are_bytes ? std::round(kByte * values[i]) : values[i]);
    }
    element->properties.push_back(std::move(column));
  }
}

std::string CommentLine(std::string comment) {
  std::replace_if(
      comment.begin(), comment.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return comment;
}

std::string Counted(std::size_t count, const std::string& noun) {
  const bool is_vertex = noun == "vertex";
  const std::string plural = is_vertex ? "vertices" : noun + "s";
  return std::to_string(count) + ' ' + (count == 1 ? noun : plural);
}

}  // namespace ceres_ed
