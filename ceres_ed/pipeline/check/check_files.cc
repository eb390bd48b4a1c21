#include "ceres_ed/pipeline/check/check_files.h"

#include <ceres_ed/io/mesh/vertex_columns.h>
#include <ceres_ed/preflight/preflight.h>

namespace ceres_ed {
namespace {

bool HasFloatPositions(const PlyDocument* document) {
  if (document == nullptr) return false;
  const PlyElement* const vertices = document->Find("vertex");
  if (vertices == nullptr) return false;
  const auto columns = FindPositionColumns(*vertices);
  return columns.has_value() && vertices->properties[(*columns)[0]].type == PlyType::kFloat32;
}

Specimen MakeSpecimen(const CheckedFile& file, const SurfaceTopology& topology) {
  return {file.path, file.cloud, &topology, HasFloatPositions(file.document)};
}

}  // namespace

std::vector<Finding> CheckFiles(const CheckedFile& source,
                                const CheckedFile& target,
                                const std::function<bool()>& should_stop) {
  const auto stopped = [&should_stop] { return should_stop && should_stop(); };
  if (source.cloud->empty() || stopped()) return {};
  const SurfaceTopology source_topology = BuildTopology(*source.cloud);
  const Specimen from = MakeSpecimen(source, source_topology);
  std::vector<Finding> findings = InspectCloud(from, should_stop);
  if (target.path.empty() || target.cloud->empty() || stopped()) return findings;
  const SurfaceTopology target_topology = BuildTopology(*target.cloud);
  const Specimen to = MakeSpecimen(target, target_topology);
  for (const auto& more : {InspectCloud(to, should_stop), InspectPair(from, to, should_stop)}) {
    findings.insert(findings.end(), more.begin(), more.end());
  }
  return findings;
}

nlohmann::ordered_json ChecksReport(const std::vector<Finding>& findings) {
  nlohmann::ordered_json report = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    report.push_back({{"code", finding.code},
                      {"severity", NameOf(finding.severity)},
                      {"text", finding.text},
                      {"fix", finding.fix},
                      {"value", finding.value}});
  }
  return report;
}

}  // namespace ceres_ed
