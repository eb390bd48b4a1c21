#include <ceres_ed/io/calibration/calibration_fields.h>
#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/util/text.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

using nlohmann::json;

// Returns {section: {key: number}}. Keys whose values are no numbers are left out.
StatusOr<json> ReadIni(const std::string& path) {
  json sections = json::object();
  std::string section;
  Status status = ForEachTextLine(path, [&](std::string_view line, int line_number) {
    const std::string place = path + ": line " + std::to_string(line_number) + ": ";
    if (line[0] == ';') return Status::Ok();
    if (line[0] == '[') {
      if (line.back() != ']') return Status::Error(place + "expected ] at the end of a section");
      section = std::string(line.substr(1, line.size() - 2));
      return Status::Ok();
    }
    const std::size_t equal = line.find_first_of("=:");
    if (equal == std::string_view::npos) {
      return Status::Error(place + Quoted(line) + ", expected [section] or name = value");
    }
    const std::optional<double> value = ParseDouble(Trim(line.substr(equal + 1)));
    if (value.has_value()) sections[section][std::string(Trim(line.substr(0, equal)))] = *value;
    return Status::Ok();
  });
  if (!status.ok()) return status;
  return sections;
}

// Reads the numbers PREFIX0, PREFIX1 and so on.
StatusOr<Eigen::VectorXd> ReadSeries(const std::string& path,
                                     const json& ini,
                                     const std::string& prefix,
                                     int count) {
  Eigen::VectorXd series(count);
  for (int i = 0; i < count; ++i) {
    const StatusOr<double> number = ReadNumber(path, ini, prefix + std::to_string(i));
    if (!number.ok()) return number.status();
    series[i] = *number;
  }
  return series;
}

Status ReadCamera(const std::string& path,
                  const json& ini,
                  const std::string& section,
                  LensCamera* camera) {
  PinholeCamera& pinhole = camera->pinhole;
  double width = 0.0;
  double height = 0.0;
  const struct {
    const char* name;
    double* value;
  } fields[] = {{"res_x", &width},
                {"res_y", &height},
                {"fc_x", &pinhole.fx},
                {"fc_y", &pinhole.fy},
                {"cc_x", &pinhole.cx},
                {"cc_y", &pinhole.cy}};
  for (const auto& field : fields) {
    const StatusOr<double> number = ReadNumber(path, ini, section + "." + field.name);
    if (!number.ok()) return number.status();
    *field.value = *number;
  }
  Status size = SetSize(path, width, height, &pinhole);
  if (!size.ok()) return size;
  const StatusOr<Eigen::VectorXd> lens =
      ReadSeries(path, ini, section + ".kc_", static_cast<int>(camera->distortion.size()));
  if (!lens.ok()) return lens.status();
  for (std::size_t i = 0; i < camera->distortion.size(); ++i) {
    camera->distortion[i] = (*lens)[static_cast<Eigen::Index>(i)];
  }
  return Status::Ok();
}

}  // namespace

StatusOr<StereoCalibration> ReadIniCalibration(const std::string& path) {
  const StatusOr<json> ini = ReadIni(path);
  if (!ini.ok()) return ini.status();
  StereoCalibration calibration;
  Status status = ReadCamera(path, *ini, "StereoLeft", &calibration.rig.left);
  if (status.ok()) status = ReadCamera(path, *ini, "StereoRight", &calibration.rig.right);
  if (!status.ok()) return status;
  const StatusOr<Eigen::VectorXd> rotation = ReadSeries(path, *ini, "StereoRight.R_", 9);
  if (!rotation.ok()) return rotation.status();
  const StatusOr<Eigen::VectorXd> translation = ReadSeries(path, *ini, "StereoRight.T_", 3);
  if (!translation.ok()) return translation.status();
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  status =
      FinishRig(path, Eigen::Map<const RowMajor>(rotation->data()), *translation, &calibration);
  if (!status.ok()) return status;
  return calibration;
}

}  // namespace ceres_ed
