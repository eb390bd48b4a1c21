#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/landmarks/landmark_parsers.h>
#include <ceres_ed/io/text.h>

#include <cmath>

#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

// Keeps the order of the members.
using Json = nlohmann::ordered_json;

// Returns the member if it is a text, otherwise an empty one.
std::string TextOf(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

class JsonParser {
 public:
  JsonParser(const std::string& path, LandmarkFile* file) : path_(path), file_(file) {}

  Status Parse() {
    const StatusOr<Json> parsed = ParseJson<Json>(path_, file_->text);
    if (!parsed.ok()) return parsed.status();
    const Json& tree = *parsed;
    if (tree.is_array()) return ParseScalismo(tree);
    const auto markups = tree.is_object() ? tree.find("markups") : tree.end();
    if (!tree.is_object() || markups == tree.end() || !markups->is_array()) {
      return Error(
          "neither markups of 3D Slicer (an object with 'markups') nor landmarks of "
          "Scalismo (a list of 'id' and 'coordinates')" +
          Intention(tree));
    }
    for (std::size_t i = 0; i < markups->size(); ++i) {
      Status status = ParseMarkup((*markups)[i], "/markups/" + std::to_string(i));
      if (!status.ok()) return status;
    }
    if (undefined_ > 0) {
      file_->warnings.push_back(path_ + ": " + std::to_string(undefined_) +
                                (undefined_ == 1 ? " point that is" : " points that are") +
                                " not defined left out");
    }
    return Status::Ok();
  }

 private:
  // Files of ours that are likely to be mistaken.
  static std::string Intention(const Json& tree) {
    if (!tree.is_object()) return "";
    if (tree.contains("graph") || tree.contains("nodes")) return "; is it a warp of ed_fit?";
    if (tree.contains("program")) return "; it is a report";
    return "";
  }

  Status ParseMarkup(const Json& markup, const std::string& place) {
    if (!markup.is_object()) return Error(place + " is no object");
    if (Status status = ParseSpace(markup, place); !status.ok()) return status;
    const auto points = markup.find("controlPoints");
    // A closed curve without points, for example.
    if (points == markup.end() || points->is_null()) return Status::Ok();
    if (!points->is_array()) return Error(place + "/controlPoints is no list");
    for (std::size_t i = 0; i < points->size(); ++i) {
      const Json& point = (*points)[i];
      const std::string here = place + "/controlPoints/" + std::to_string(i);
      if (!point.is_object()) return Error(here + " is no object");
      const std::string defined = TextOf(point, "positionStatus");
      const auto position = point.find("position");
      if ((!defined.empty() && defined != "defined") || position == point.end() ||
          position->is_null()) {
        ++undefined_;
        continue;
      }
      const std::string label = TextOf(point, "label");
      Status status =
          AddPoint(label.empty() ? TextOf(point, "id") : label, *position, here + "/position");
      if (!status.ok()) return status;
    }
    return Status::Ok();
  }

  // The schema's default is LPS; the first versions wrote numbers.
  Status ParseSpace(const Json& markup, const std::string& place) {
    const auto found = markup.find("coordinateSystem");
    AnatomicalSpace space = AnatomicalSpace::kLps;
    if (found != markup.end()) {
      const std::string text = found->is_string() ? found->get<std::string>() : found->dump();
      if (text == "RAS" || text == "0") {
        space = AnatomicalSpace::kRas;
      } else if (text != "LPS" && text != "1") {
        return Error(place + "/coordinateSystem is " + Quoted(text) + ", expected LPS or RAS");
      }
    }
    if (!file_->points.empty() && file_->space != space) {
      return Error(place +
                   "/coordinateSystem differs from that of the markups ahead of it, "
                   "expected one for all");
    }
    file_->space = space;
    return Status::Ok();
  }

  Status ParseScalismo(const Json& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string here = "/" + std::to_string(i);
      if (!list[i].is_object()) return Error(here + " is no object");
      const auto coordinates = list[i].find("coordinates");
      if (coordinates == list[i].end()) return Error(here + " has no 'coordinates'");
      Status status = AddPoint(TextOf(list[i], "id"), *coordinates, here + "/coordinates");
      if (!status.ok()) return status;
    }
    return Status::Ok();
  }

  Status AddPoint(const std::string& name, const Json& position, const std::string& place) {
    NamedLandmark point;
    point.name = name;
    if (!position.is_array() || position.size() != 3) {
      return Error(place + " is no list of three numbers");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = position[i].is_number() ? position[i].get<double>() : NAN;
      if (!std::isfinite(value)) {
        return Error(place + "/" + std::to_string(i) + " is " +
                     Quoted(position[i].dump(-1, ' ', false, Json::error_handler_t::replace)) +
                     ", expected a finite number");
      }
      point.position[static_cast<Eigen::Index>(i)] = value;
    }
    file_->points.push_back(std::move(point));
    file_->pointers.push_back(place);
    return Status::Ok();
  }

  Status Error(const std::string& what) const { return Status::Error(path_ + ": " + what); }

  const std::string& path_;
  LandmarkFile* file_;
  std::size_t undefined_ = 0;
};

}  // namespace

Status ParseLandmarkJson(const std::string& path, LandmarkFile* file) {
  return JsonParser(path, file).Parse();
}

std::string EncodeLandmarkJson(const LandmarkFile& file,
                               const std::vector<Eigen::Vector3d>& positions) {
  Json tree = Json::parse(file.text);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3d& p = positions[i];
    tree[Json::json_pointer(file.pointers[i])] = {p.x(), p.y(), p.z()};
  }
  constexpr int kIndent = 4;
  return tree.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace ceres_ed
