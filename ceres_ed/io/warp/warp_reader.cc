#include "ceres_ed/io/warp_io.h"

#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/warp/warp_format.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using nlohmann::json;

// The tolerance accepts a rotation that was written with few digits.
constexpr double kUnitNormTolerance = 1e-6;

// Reads fields from a JSON tree and stores the first error.
class FieldReader {
 public:
  explicit FieldReader(std::string path) : path_(std::move(path)) {}

  const Status& status() const { return status_; }
  bool ok() const { return status_.ok(); }

  void Fail(const std::string& place, const std::string& what) {
    if (ok()) status_ = Status::Error(path_ + ": " + place + " " + what);
  }

  // Returns the member, or a null value after an error.
  const json& Member(const json& object, const std::string& place, const char* name) {
    static const json kNull;
    const std::string full = place.empty() ? name : place + "." + name;
    if (!object.is_object()) {
      Fail(place.empty() ? "the file" : place, "is " + TypeOf(object) + ", expected an object");
      return kNull;
    }
    const auto found = object.find(name);
    if (found != object.end()) return *found;
    Fail(full, "is missing");
    return kNull;
  }

  void Numbers(const json& array, const std::string& place, std::size_t size, double* values) {
    if (!ok()) return;
    if (!array.is_array() || array.size() != size) {
      const std::string found = array.is_array() ? "has " + std::to_string(array.size()) + " values"
                                                 : "is " + TypeOf(array);
      return Fail(place, found + ", expected " + std::to_string(size) + " numbers");
    }
    for (std::size_t i = 0; i < size; ++i) {
      values[i] = Number(array[i], place + "[" + std::to_string(i) + "]");
    }
  }

  double Number(const json& value, const std::string& place) {
    if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
    Fail(place, "is " + TypeOf(value) + ", expected a finite number");
    return 0.0;
  }

  // Returns a whole number in [low, high].
  int Integer(const json& value, const std::string& place, int low, int high) {
    if (value.is_number_integer()) {
      // The number is read as a double, so that an unsigned one above 2^63 does not overflow.
      const double number = value.get<double>();
      if (number >= low && number <= high) return static_cast<int>(number);
    }
    Fail(place,
         "is " + (value.is_number() ? value.dump() : TypeOf(value)) +
             ", expected a whole number from " + std::to_string(low) + " to " +
             std::to_string(high));
    return low;
  }

  const json& Array(const json& value, const std::string& place) {
    static const json kEmpty = json::array();
    if (value.is_array()) return value;
    Fail(place, "is " + TypeOf(value) + ", expected an array");
    return kEmpty;
  }

 private:
  static std::string TypeOf(const json& value) {
    return value.is_string() ? Quoted(value.get_ref<const std::string&>()) : value.type_name();
  }

  std::string path_;
  Status status_ = Status::Ok();
};

void ReadFormat(const json& root, FieldReader* reader) {
  const json& format = reader->Member(root, "", "format");
  if (!reader->ok()) return;
  if (format != kWarpFormat)
    return reader->Fail("format", "is not \"ceres_ed_warp\": no warp file");
  const json& version = reader->Member(root, "", "version");
  if (!reader->ok()) return;
  const int number = reader->Integer(version, "version", 1, 1 << 30);
  if (reader->ok() && number > kWarpVersion) {
    reader->Fail("version",
                 "is " + std::to_string(number) + ", this program reads up to " +
                     std::to_string(kWarpVersion));
  }
}

void ReadSimilarity(const json& root, FieldReader* reader, Similarity* similarity) {
  const std::string place = "target_from_source";
  const json& object = reader->Member(root, "", place.c_str());
  if (!reader->ok()) return;
  similarity->scale = reader->Number(reader->Member(object, place, "scale"), place + ".scale");
  double wxyz[4] = {1.0, 0.0, 0.0, 0.0};
  reader->Numbers(reader->Member(object, place, "rotation"), place + ".rotation", 4, wxyz);
  reader->Numbers(reader->Member(object, place, "translation"),
                  place + ".translation",
                  3,
                  similarity->translation.data());
  if (!reader->ok()) return;
  similarity->rotation = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(similarity->scale > 0.0)) {
    reader->Fail(place + ".scale",
                 "is " + json(similarity->scale).dump() + ", expected more than 0");
  }
  const double norm = similarity->rotation.norm();
  if (std::abs(norm - 1.0) > kUnitNormTolerance) {
    reader->Fail(place + ".rotation", "has the norm " + json(norm).dump() + ", expected 1");
  }
}

void ReadBinding(const json& root, FieldReader* reader, BindingOptions* binding) {
  const json& object = reader->Member(root, "", "binding");
  if (!reader->ok()) return;
  binding->neighbors = reader->Integer(
      reader->Member(object, "binding", "neighbors"), "binding.neighbors", 1, kMaxBoundNodes);
  const json& distance = reader->Member(object, "binding", "distance");
  if (!reader->ok()) return;
  if (distance == kSurfaceRule) {
    binding->distance = DistanceRule::kSurface;
  } else if (distance == kEuclideanRule) {
    binding->distance = DistanceRule::kEuclidean;
  } else {
    reader->Fail("binding.distance", "is unknown, expected \"surface\" or \"euclidean\"");
  }
}

// Files of surfaces, and those of earlier versions, do not have this field.
int ReadNumInnerNodes(const json& root, int num_nodes, FieldReader* reader) {
  const auto found = root.find("inner_nodes");
  return found == root.end() ? 0 : reader->Integer(*found, "inner_nodes", 0, num_nodes - 1);
}

void ReadNodes(const json& root, FieldReader* reader, Warp* warp) {
  const json& nodes = reader->Array(reader->Member(root, "", "nodes"), "nodes");
  if (reader->ok() && nodes.empty()) reader->Fail("nodes", "is empty, expected at least one");
  if (!reader->ok()) return;
  const int num_nodes = static_cast<int>(nodes.size());
  const int num_inner = ReadNumInnerNodes(root, num_nodes, reader);
  warp->state.Resize(num_nodes);
  for (std::size_t j = 0; j < nodes.size() && reader->ok(); ++j) {
    const std::string place = "nodes[" + std::to_string(j) + "]";
    double* const block = warp->state.node(static_cast<int>(j));
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    reader->Numbers(reader->Member(nodes[j], place, "g"), place + ".g", 3, position.data());
    reader->Numbers(reader->Member(nodes[j], place, "A"), place + ".A", kWarpAffineSize, block);
    reader->Numbers(
        reader->Member(nodes[j], place, "t"), place + ".t", 3, block + kNodeTranslationOffset);
    if (static_cast<int>(j) < num_nodes - num_inner) {
      warp->graph.AddNode(position);
    } else {
      warp->graph.AddInnerNode(position);
    }
  }
}

void ReadEdges(const json& root, FieldReader* reader, Warp* warp) {
  const json& edges = reader->Array(reader->Member(root, "", "edges"), "edges");
  const int last_node = warp->graph.num_nodes() - 1;
  for (std::size_t e = 0; e < edges.size() && reader->ok(); ++e) {
    const std::string place = "edges[" + std::to_string(e) + "]";
    double values[3] = {0.0, 0.0, 0.0};
    reader->Numbers(edges[e], place, 3, values);
    if (!reader->ok()) return;
    GraphEdge edge;
    edge.from = reader->Integer(edges[e][0], place + "[0]", 0, last_node);
    edge.to = reader->Integer(edges[e][1], place + "[1]", 0, last_node);
    edge.weight = values[2];
    if (edge.weight < 0.0) reader->Fail(place + "[2]", "is negative, expected at least 0");
    if (edge.from == edge.to) reader->Fail(place, "joins a node to itself");
    if (reader->ok()) warp->graph.AddEdge(edge);
  }
}

// Files of fits without a finish do not have this field.
void ReadFinish(const json& root, FieldReader* reader, VertexField* field) {
  const auto found = root.find("finish");
  if (found == root.end()) return;
  const json& member = reader->Member(*found, "finish", "points");
  if (!reader->ok()) return;
  const json& points = reader->Array(member, "finish.points");
  for (std::size_t p = 0; p < points.size() && reader->ok(); ++p) {
    double values[6] = {};
    reader->Numbers(points[p], "finish.points[" + std::to_string(p) + "]", 6, values);
    field->points.emplace_back(values[0], values[1], values[2]);
    field->displacements.emplace_back(values[3], values[4], values[5]);
  }
}

// Files of fits without --repair do not have this field.
void ReadRepaired(const json& root, FieldReader* reader, bool* repaired) {
  const auto found = root.find("repaired");
  if (found == root.end()) return;
  if (!found->is_boolean()) return reader->Fail("repaired", "is not true or false");
  *repaired = found->get<bool>();
}

}  // namespace

StatusOr<Warp> ReadWarp(const std::string& path) {
  const StatusOr<std::string> text = ReadWholeFile(path);
  if (!text.ok()) return text.status();
  const StatusOr<json> parsed = ParseJson<json>(path, *text);
  if (!parsed.ok()) return parsed.status();
  const json& root = *parsed;
  FieldReader reader(path);
  Warp warp;
  ReadFormat(root, &reader);
  if (reader.ok()) ReadSimilarity(root, &reader, &warp.target_from_source);
  if (reader.ok()) ReadBinding(root, &reader, &warp.binding);
  if (reader.ok()) ReadNodes(root, &reader, &warp);
  if (reader.ok()) ReadEdges(root, &reader, &warp);
  if (reader.ok()) ReadRepaired(root, &reader, &warp.repaired);
  if (reader.ok()) ReadFinish(root, &reader, &warp.finish);
  if (!reader.ok()) return reader.status();
  return warp;
}

}  // namespace ceres_ed
