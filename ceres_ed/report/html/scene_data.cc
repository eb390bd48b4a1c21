#include "ceres_ed/report/html/scene_data.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/report/html/base64.h>
#include <ceres_ed/report/html/timeline_data.h>
#include <ceres_ed/report/view/view_camera.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

ordered_json List(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ordered_json List(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

ordered_json PointsData(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box = BoundingBox(points);
  if (points.empty()) box = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  return {{"low", List(box.min())},
          {"high", List(box.max())},
          {"steps", Base64OfUint16(QuantizePoints(points, box))}};
}

// Returns whole numbers >= 0 with 16 bits each, or with 32 if one needs them.
template <typename Number>
ordered_json NumbersData(const std::vector<Number>& numbers) {
  const bool is_wide =
      !numbers.empty() && *std::max_element(numbers.begin(), numbers.end()) > 65535;
  if (is_wide) {
    return {{"bits", 32},
            {"data", Base64OfUint32(std::vector<std::uint32_t>(numbers.begin(), numbers.end()))}};
  }
  return {{"bits", 16},
          {"data", Base64OfUint16(std::vector<std::uint16_t>(numbers.begin(), numbers.end()))}};
}

std::string BytesData(const std::vector<Rgb>& colors) {
  std::string bytes;
  for (const Rgb& color : colors) {
    for (const std::uint8_t part : color) bytes += static_cast<char>(part);
  }
  return Base64(bytes);
}

ordered_json FieldData(const ScalarField& field) {
  const FieldRange& range = field.range;
  return {{"key", field.key},
          {"name", field.name},
          {"unit", field.unit},
          {"scale", field.scale == ColorScale::kSigned ? "signed" : "magnitude"},
          {"low", range.low},
          {"high", range.high},
          {"min", range.min},
          {"max", range.max},
          {"note", AsideNote(field)},
          {"steps", Base64OfUint16(Quantize(field.values, range.min, range.max))},
          {"hidden", field.hides_aside ? NumbersData(field.aside) : ordered_json(nullptr)}};
}

// A node has 16 numbers: position, rotation (w x y z), the upper triangle of the stretch row by
// row, and translation.
ordered_json MotionData(const ViewSurface& surface) {
  const WarpMotion& motion = *surface.motion;
  std::vector<double> nodes;
  for (const NodeMotion& node : motion.nodes) {
    const Eigen::Quaterniond& q = node.rotation;
    const Eigen::Matrix3d& s = node.stretch;
    nodes.insert(nodes.end(), node.position.begin(), node.position.end());
    nodes.insert(nodes.end(), {q.w(), q.x(), q.y(), q.z()});
    nodes.insert(nodes.end(), {s(0, 0), s(0, 1), s(0, 2), s(1, 1), s(1, 2), s(2, 2)});
    nodes.insert(nodes.end(), node.translation.begin(), node.translation.end());
  }
  ordered_json data = {{"stride", motion.stride},
                       {"nodes", Base64OfDoubles(nodes)},
                       {"bound", NumbersData(motion.bound)},
                       {"weights", Base64OfUint16(Quantize(motion.weights, 0.0, 1.0))},
                       {"finish", nullptr},
                       {"scale", motion.target_from_source.scale},
                       {"rotation", List(motion.target_from_source.rotation)},
                       {"translation", List(motion.target_from_source.translation)},
                       {"center", List(motion.center)},
                       {"placement", PlacementShareOf(surface)}};
  if (!motion.finish.empty()) data["finish"] = PointsData(motion.finish);
  return data;
}

ordered_json MomentsData(const PointMoments& moments) {
  ordered_json data = {{"count", moments.count},
                       {"first", NumbersData(moments.first)},
                       {"last", NumbersData(moments.last)},
                       {"places", nullptr}};
  if (!moments.places.empty()) data["places"] = PointsData(moments.places);
  return data;
}

ordered_json SurfaceData(const ViewSurface& surface) {
  std::vector<int> corners;
  for (const auto& triangle : surface.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  ordered_json data = {{"name", surface.name},
                       {"points", PointsData(surface.points)},
                       {"faces", NumbersData(corners)},
                       {"rows", NumbersData(surface.rows)},
                       {"fields", ordered_json::array()},
                       {"motion", nullptr},
                       {"moments", nullptr},
                       {"spacing", surface.spacing},
                       {"colors", nullptr},
                       {"normals", nullptr}};
  for (const ScalarField& field : surface.fields) data["fields"].push_back(FieldData(field));
  if (surface.motion) data["motion"] = MotionData(surface);
  if (surface.moments) data["moments"] = MomentsData(*surface.moments);
  if (!surface.colors.empty()) data["colors"] = BytesData(surface.colors);
  if (!surface.normals.empty()) data["normals"] = PointsData(surface.normals);
  return data;
}

ordered_json GraphData(const ViewGraph& graph) {
  if (graph.empty()) return nullptr;
  std::vector<int> ends;
  for (const auto& [from, to] : graph.edges) ends.insert(ends.end(), {from, to});
  std::vector<int> kinds;
  for (const NodeKind kind : graph.kinds) kinds.push_back(static_cast<int>(kind));
  return {{"edges", NumbersData(ends)}, {"kinds", NumbersData(kinds)}};
}

}  // namespace

ordered_json SceneData(const Scene& scene) {
  const SceneBall ball = BallAround(scene);
  const ViewCamera camera = ChooseCamera(scene);
  ordered_json data = {{"center", List(ball.center)},
                       {"radius", ball.radius},
                       {"camera", {{"from", List(camera.from)}, {"up", List(camera.up)}}},
                       {"field", scene.first_field},
                       {"colors",
                        {{"magnitude", BytesData(ColorTable(ColorScale::kMagnitude))},
                         {"signed", BytesData(ColorTable(ColorScale::kSigned))},
                         {"unknown", kUnknownColor}}},
                       {"surfaces", ordered_json::array()},
                       {"graph", GraphData(scene.graph)},
                       {"landmarks", ordered_json::array()},
                       {"timeline", nullptr},
                       {"panels", ordered_json::array()}};
  if (scene.timeline) data["timeline"] = TimelineData(*scene.timeline);
  for (const ViewSurface& surface : scene.surfaces)
    data["surfaces"].push_back(SurfaceData(surface));
  for (const ViewLandmark& landmark : scene.landmarks) {
    data["landmarks"].push_back({{"name", landmark.name},
                                 {"point", landmark.point},
                                 {"wanted", List(landmark.wanted)},
                                 {"error", landmark.error}});
  }
  for (const ViewPanel& panel : scene.panels) {
    data["panels"].push_back({{"title", panel.title},
                              {"surface", panel.surface},
                              {"at", panel.at},
                              {"graph", panel.with_graph},
                              {"colored", panel.is_colored}});
  }
  return data;
}

}  // namespace ceres_ed
